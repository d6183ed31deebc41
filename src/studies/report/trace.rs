//! Traces for the viewers of Chrome and Perfetto: the JSON object form of the trace event format.
//!
//! One process, a thread per lane. Slices are complete events (`X`), names and order of the lanes are metadata (`M`),
//! arrows are flows (`s` to `f`). Inputs are picoseconds; the format requires microseconds. Perfetto rounds starts and
//! durations to nanoseconds separately, and drops a slice that then overlaps another. So slice ends are rounded to
//! whole nanoseconds first; the details of a slice keep the picoseconds.

use std::io::{self, Write};

use serde::Serialize;
use serde_json::{Map, Value, json};

const PROCESS: u32 = 1;

/// Event with a duration.
#[derive(Clone, Debug, PartialEq)]
pub struct Slice {
    /// Index of the lane in [`Trace::lanes`].
    pub lane: usize,
    /// Name.
    pub name: String,
    /// Category, by which viewers filter.
    pub category: String,
    /// Start, in picoseconds.
    pub start: u64,
    /// Duration, in picoseconds.
    pub duration: u64,
    /// Details shown by viewers.
    pub details: Map<String, Value>,
}

/// Arrow from a moment of one slice to a moment of another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Arrow {
    /// Lane and picosecond of its start, which lies inside a slice or at one of its ends.
    pub from: (usize, u64),
    /// Lane and picosecond of its end.
    pub to: (usize, u64),
}

/// Timeline on parallel lanes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trace {
    /// Title.
    pub title: String,
    /// Names of the lanes, from the top.
    pub lanes: Vec<String>,
    /// Slices; slices in one lane are disjoint or nested.
    pub slices: Vec<Slice>,
    /// Arrows.
    pub arrows: Vec<Arrow>,
    /// Additional metadata for people who open the file.
    pub about: Map<String, Value>,
}

#[derive(Serialize)]
#[serde(tag = "ph")]
enum Event<'a> {
    #[serde(rename = "X")]
    Complete { name: &'a str, cat: &'a str, ts: f64, dur: f64, pid: u32, tid: u32, args: Map<String, Value> },
    #[serde(rename = "M")]
    Metadata { name: &'a str, pid: u32, tid: u32, args: Value },
    #[serde(rename = "s")]
    FlowStart { name: &'a str, cat: &'a str, id: usize, ts: f64, pid: u32, tid: u32 },
    #[serde(rename = "f")]
    FlowEnd { name: &'a str, cat: &'a str, id: usize, ts: f64, pid: u32, tid: u32, bp: &'a str },
}

impl Trace {
    /// Writes the file: slices in order of time, one event per line. Fails if `out` does.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "{{\"displayTimeUnit\":\"ns\",\"otherData\":{},", Value::Object(self.about.clone()))?;
        write!(out, "\"traceEvents\":[")?;
        let mut first = true;
        self.events(&mut |event| {
            writeln!(out, "{}", if std::mem::take(&mut first) { "" } else { "," })?;
            serde_json::to_writer(&mut *out, &event).map_err(io::Error::from)
        })?;
        writeln!(out, "\n]}}")
    }

    fn events(&self, write: &mut dyn FnMut(Event<'_>) -> io::Result<()>) -> io::Result<()> {
        let named = |name, tid, args| Event::Metadata { name, pid: PROCESS, tid, args };
        write(named("process_name", 0, json!({ "name": self.title })))?;
        for (lane, name) in self.lanes.iter().enumerate() {
            write(named("thread_name", tid(lane), json!({ "name": name })))?;
            write(named("thread_sort_index", tid(lane), json!({ "sort_index": tid(lane) })))?;
        }
        let mut slices: Vec<&Slice> = self.slices.iter().collect();
        // At equal starts, the longest slice comes first, since it contains the others.
        slices.sort_by_key(|slice| (slice.start, slice.lane, std::cmp::Reverse(slice.duration)));
        for Slice { lane, name, category, start, duration, details } in slices {
            let (from, to) = (nanosecond(*start), nanosecond(start.saturating_add(*duration)));
            let (ts, dur) = (microseconds(from), microseconds(to - from));
            let mut args = details.clone();
            args.insert("start_ps".to_owned(), (*start).into());
            args.insert("duration_ps".to_owned(), (*duration).into());
            write(Event::Complete { name, cat: category, ts, dur, pid: PROCESS, tid: tid(*lane), args })?;
        }
        for (id, arrow) in self.arrows.iter().enumerate() {
            let (name, cat, pid) = ("critical path", "path", PROCESS);
            let (lane, at) = arrow.from;
            write(Event::FlowStart { name, cat, id, ts: microseconds(nanosecond(at)), pid, tid: tid(lane) })?;
            let (lane, at) = arrow.to;
            write(Event::FlowEnd { name, cat, id, ts: microseconds(nanosecond(at)), pid, tid: tid(lane), bp: "e" })?;
        }
        Ok(())
    }
}

/// Thread id of a lane; 0 is the process itself.
fn tid(lane: usize) -> u32 {
    u32::try_from(lane).unwrap_or(u32::MAX - 1).saturating_add(1)
}

fn nanosecond(picosecond: u64) -> u64 {
    picosecond / 1000
}

/// A double keeps three decimals up to 9007199 s.
fn microseconds(nanoseconds: u64) -> f64 {
    nanoseconds as f64 / 1e3
}
