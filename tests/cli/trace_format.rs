//! A strict reader of the trace event format in its JSON object form, as far as Crossbar writes it: complete events,
//! metadata and flows. It panics at anything that the format does not define, or that viewers drop. Like Perfetto, it
//! rounds starts and durations to nanoseconds separately, and requires slices that still do not overlap.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::Value;

/// A slice on a thread, in nanoseconds, and its exact end in picoseconds.
#[derive(Clone, Debug)]
pub(crate) struct Slice {
    pub(crate) name: String,
    pub(crate) category: String,
    start: u64,
    end: u64,
    pub(crate) end_ps: u64,
}

/// The trace as a viewer shows it: threads by name, in display order, with their slices.
#[derive(Debug)]
pub(crate) struct Shown {
    pub(crate) process: String,
    pub(crate) threads: Vec<(String, Vec<Slice>)>,
    pub(crate) flows: usize,
    pub(crate) about: Value,
}

/// Asserts that an object has these keys and no others.
fn has(object: &Value, keys: &str) {
    let found: BTreeSet<&str> = object.as_object().expect("an object").keys().map(String::as_str).collect();
    assert_eq!(found, keys.split(' ').collect(), "{object}");
}

fn text(value: &Value) -> String {
    value.as_str().unwrap_or_else(|| panic!("expected text, found {value}")).to_owned()
}

/// Reads a trace and checks the requirements of viewers: one named process, named and ordered threads, slices of each
/// thread in order without overlap, flows in pairs whose ends lie in slices.
pub(crate) fn read(trace: &str) -> Shown {
    let file: Value = serde_json::from_str(trace).expect("one JSON document");
    has(&file, "displayTimeUnit otherData traceEvents");
    assert_eq!(file["displayTimeUnit"], "ns");
    let (mut processes, mut names, mut places) = (Vec::new(), BTreeMap::new(), BTreeMap::new());
    let mut slices: BTreeMap<u64, Vec<Slice>> = BTreeMap::new();
    let (mut starts, mut ends, mut latest) = (BTreeMap::new(), BTreeMap::new(), 0);
    let events = file["traceEvents"].as_array().expect("events");
    for event in events {
        assert_eq!(event["pid"], events[0]["pid"], "one process: {event}");
        let tid = event["tid"].as_u64().expect("a thread");
        let nanoseconds = |key: &str| (event[key].as_f64().expect(key) * 1e3).round() as u64;
        let flow = || (event["name"].clone(), event["cat"].clone(), nanoseconds("ts"), tid);
        let (name, args) = (text(&event["name"]), &event["args"]);
        match text(&event["ph"]).as_str() {
            "M" => {
                has(event, "args name ph pid tid");
                match name.as_str() {
                    "process_name" => processes.push(text(&args["name"])),
                    "thread_name" => _ = names.insert(tid, text(&args["name"])),
                    "thread_sort_index" => _ = places.insert(tid, args["sort_index"].as_i64().expect("a place")),
                    "process_labels" | "process_sort_index" => {}
                    _ => panic!("{event}"),
                }
            }
            "X" => {
                has(event, "args cat dur name ph pid tid ts");
                let [start_ps, duration_ps] = ["start_ps", "duration_ps"].map(|key| args[key].as_u64().expect(key));
                let (start, duration, end_ps) = (nanoseconds("ts"), nanoseconds("dur"), start_ps + duration_ps);
                let end = start + duration;
                assert!(
                    start >= latest && duration_ps > 0 && !name.is_empty() && !args["command"].is_null(),
                    "{event}"
                );
                assert_eq!((start, end), (start_ps / 1000, end_ps / 1000), "{event}");
                latest = start;
                slices.entry(tid).or_default().push(Slice { name, category: text(&event["cat"]), start, end, end_ps });
            }
            "s" => {
                has(event, "cat id name ph pid tid ts");
                assert!(starts.insert(event["id"].as_u64().expect("a number"), flow()).is_none(), "{event}");
            }
            "f" => {
                has(event, "bp cat id name ph pid tid ts");
                assert_eq!(event["bp"], "e", "it binds to the enclosing slice");
                ends.insert(event["id"].as_u64().expect("a number"), flow());
            }
            _ => panic!("{event}"),
        }
    }
    let [process] = &processes[..] else { panic!("expected one process with a name, found {processes:?}") };
    assert!(
        names.keys().eq(places.keys()) && slices.keys().all(|tid| names.contains_key(tid)),
        "{names:?}, {places:?}"
    );
    assert!(starts.keys().eq(ends.keys()), "flows come in pairs");
    for ((name, cat, from, tid), end) in starts.values().zip(ends.values()) {
        let lies =
            |tid: &u64, at: u64| slices.get(tid).is_some_and(|all| all.iter().any(|s| s.start <= at && at <= s.end));
        assert_eq!((name, cat), (&end.0, &end.1));
        assert!(end.2 >= *from && lies(tid, *from) && lies(&end.3, end.2), "flow from {from} to {end:?}");
    }
    for pair in slices.values().flat_map(|slices| slices.windows(2)) {
        assert!(pair[1].start >= pair[0].end, "two at a time: {pair:?}");
    }
    let mut order: Vec<(i64, u64)> = places.into_iter().map(|(tid, place)| (place, tid)).collect();
    order.sort_unstable();
    let thread = |(_, tid)| (names.remove(&tid).unwrap_or_default(), slices.remove(&tid).unwrap_or_default());
    let threads = order.into_iter().map(thread).collect();
    Shown { process: process.clone(), threads, flows: starts.len(), about: file["otherData"].clone() }
}
