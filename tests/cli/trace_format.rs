//! A strict reader of the trace event format in its JSON object form, as far as Crossbar writes it: complete events,
//! metadata and flows. Anything that the format does not define, or that viewers drop, is an error. Like Perfetto, it
//! rounds starts and durations to nanoseconds separately, and requires slices that still do not overlap.

use std::collections::{BTreeMap, BTreeSet};

use serde::Deserialize;
use serde_json::{Map, Value};

/// A trace file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "camelCase")]
pub(crate) struct TraceFile {
    pub(crate) trace_events: Vec<Event>,
    pub(crate) display_time_unit: TimeUnit,
    pub(crate) other_data: Map<String, Value>,
}

/// The unit in which viewers show times.
#[derive(Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum TimeUnit {
    Ms,
    Ns,
}

/// An event by its phase, with times in microseconds.
#[derive(Debug, Deserialize)]
#[serde(tag = "ph", deny_unknown_fields)]
pub(crate) enum Event {
    #[serde(rename = "X")]
    Complete {
        name: String,
        cat: String,
        ts: f64,
        dur: f64,
        pid: u32,
        tid: u32,
        #[serde(default)]
        args: Map<String, Value>,
    },
    #[serde(rename = "M")]
    Metadata { name: MetadataName, pid: u32, tid: u32, args: Map<String, Value> },
    #[serde(rename = "s")]
    FlowStart { name: String, cat: String, id: u64, ts: f64, pid: u32, tid: u32 },
    #[serde(rename = "f")]
    FlowEnd { name: String, cat: String, id: u64, ts: f64, pid: u32, tid: u32, bp: BindingPoint },
}

/// Metadata names that the format defines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum MetadataName {
    ProcessName,
    ProcessLabels,
    ProcessSortIndex,
    ThreadName,
    ThreadSortIndex,
}

/// Binding of a flow's end to the enclosing slice, not to the next one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub(crate) enum BindingPoint {
    #[serde(rename = "e")]
    Enclosing,
}

/// A slice on a thread, in nanoseconds, and its exact end in picoseconds.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Slice {
    pub(crate) name: String,
    pub(crate) category: String,
    pub(crate) start: u64,
    pub(crate) end: u64,
    pub(crate) end_ps: u64,
}

/// Microseconds as a viewer rounds them.
fn nanoseconds(microseconds: f64) -> u64 {
    (microseconds * 1e3).round() as u64
}

/// The trace as a viewer shows it: threads by name, in display order, with their slices.
#[derive(Debug)]
pub(crate) struct Shown {
    pub(crate) process: String,
    pub(crate) threads: Vec<(String, Vec<Slice>)>,
    pub(crate) flows: usize,
    pub(crate) about: Map<String, Value>,
}

/// Reads a trace and checks the requirements of viewers: one named process, named and ordered threads, slices of each
/// thread in order without overlap, flows in pairs whose ends lie in slices.
pub(crate) fn read(text: &str) -> Result<Shown, String> {
    let file: TraceFile = serde_json::from_str(text).map_err(|error| error.to_string())?;
    let (mut processes, mut names, mut places) = (BTreeMap::new(), BTreeMap::new(), BTreeMap::new());
    let mut slices: BTreeMap<u32, Vec<Slice>> = BTreeMap::new();
    let (mut starts, mut ends, mut latest) = (BTreeMap::new(), BTreeMap::new(), 0);
    let mut pids = BTreeSet::new();
    for event in file.trace_events {
        match event {
            Event::Metadata { name, pid, tid, args } => {
                pids.insert(pid);
                let text = || args.get("name").and_then(Value::as_str).map(str::to_owned).ok_or("a name without text");
                match name {
                    MetadataName::ProcessName => _ = processes.insert(pid, text()?),
                    MetadataName::ThreadName => _ = names.insert(tid, text()?),
                    MetadataName::ThreadSortIndex => {
                        let place = args.get("sort_index").and_then(Value::as_i64).ok_or("a place without a number")?;
                        places.insert(tid, place);
                    }
                    MetadataName::ProcessLabels | MetadataName::ProcessSortIndex => {}
                }
            }
            Event::Complete { name, cat, ts, dur, pid, tid, args } => {
                pids.insert(pid);
                let exact =
                    |key: &str| args.get(key).and_then(Value::as_u64).ok_or(format!("`{name}` without `{key}`"));
                let (start_ps, duration_ps) = (exact("start_ps")?, exact("duration_ps")?);
                let (start, duration) = (nanoseconds(ts), nanoseconds(dur));
                if start < latest || dur < 0.0 || duration_ps == 0 || name.is_empty() || !args.contains_key("command") {
                    return Err(format!("slice `{name}` at {ts} for {dur} after {latest}"));
                }
                let (end, end_ps) = (start + duration, start_ps + duration_ps);
                if (start, end) != (start_ps / 1000, end_ps / 1000) {
                    return Err(format!("slice `{name}` at {ts} for {dur}, exactly {start_ps} to {end_ps}"));
                }
                latest = start;
                slices.entry(tid).or_default().push(Slice { name, category: cat, start, end, end_ps });
            }
            Event::FlowStart { name, cat, id, ts, pid, tid } => {
                pids.insert(pid);
                if starts.insert(id, (name, cat, nanoseconds(ts), tid)).is_some() {
                    return Err(format!("flow {id} starts twice"));
                }
            }
            Event::FlowEnd { name, cat, id, ts, pid, tid, bp: BindingPoint::Enclosing } => {
                pids.insert(pid);
                ends.insert(id, (name, cat, nanoseconds(ts), tid));
            }
        }
    }
    if pids.len() != 1 || processes.len() != 1 || file.display_time_unit != TimeUnit::Ns {
        return Err(format!("expected one process with a name, found {pids:?} and {processes:?}"));
    }
    if !names.keys().eq(places.keys()) || !slices.keys().all(|tid| names.contains_key(tid)) {
        return Err(format!("expected a name and a place for every thread, found {names:?} and {places:?}"));
    }
    for (id, (name, cat, ts, tid)) in &starts {
        let end = ends.get(id).ok_or_else(|| format!("flow {id} has no end"))?;
        let lies =
            |tid: &u32, at: u64| slices.get(tid).is_some_and(|all| all.iter().any(|s| s.start <= at && at <= s.end));
        if (name, cat) != (&end.0, &end.1) || end.2 < *ts || !lies(tid, *ts) || !lies(&end.3, end.2) {
            return Err(format!("flow {id} from {ts} to {end:?}"));
        }
    }
    if starts.len() != ends.len() {
        return Err("a flow ends that did not start".to_owned());
    }
    for slices in slices.values() {
        if let Some(pair) = slices.windows(2).find(|pair| pair[1].start < pair[0].end) {
            return Err(format!("two at a time: {pair:?}"));
        }
    }
    let mut order: Vec<(i64, u32)> = places.into_iter().map(|(tid, place)| (place, tid)).collect();
    order.sort_unstable();
    let thread =
        |(_, tid): (i64, u32)| (names.remove(&tid).unwrap_or_default(), slices.remove(&tid).unwrap_or_default());
    let threads = order.into_iter().map(thread).collect();
    let process = processes.into_values().next().unwrap_or_default();
    Ok(Shown { process, threads, flows: starts.len(), about: file.other_data })
}
