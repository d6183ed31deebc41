//! `crossbar timeline`: tables, document and trace of a run.

use std::fs;

use serde_json::Value;

use crate::answers::{document, number};
use crate::case::{CASES, example};
use crate::crossbar;

/// A small crossbar.
const RAYS: &[&str] = &["timeline", "--eye-rays", "33x2"];

fn sum(list: &Value, field: &str) -> f64 {
    list.as_array().expect("a list").iter().map(|entry| number(&entry[field])).sum()
}

/// Asserts that times, in microseconds, are equal up to the rounding of their conversion.
fn assert_same(sum: f64, total: f64, what: &dyn std::fmt::Display) {
    assert!((sum - total).abs() <= 1e-9 * total, "{what}: {sum}, {total}");
}

/// Checks relations between the figures of a document.
fn check(document: &Value, models: &[&str]) {
    let of = |field: &str| document[field].as_array().expect("a list").clone();
    let found: Vec<Value> = of("models").iter().map(|model| model["model"].clone()).collect();
    assert_eq!(found, models);
    for (model, totals) in of("models").iter().zip(of("totals")) {
        let total = number(&totals["total"]);
        assert!(total > 0.0 && totals["model"] == model["model"], "{totals}");
        assert_same(sum(&model["critical_path"], "time"), total, &"the path is the whole run");
        for unit in model["units"].as_array().expect("units") {
            assert_same(["busy", "waiting", "idle"].map(|part| number(&unit[part])).iter().sum(), total, unit);
        }
        for draw in model["draws"].as_array().expect("draws") {
            let longest =
                ["front_end", "shader", "memory"].map(|part| number(&draw[part])).into_iter().fold(0.0, f64::max);
            assert!(number(&draw["total"]) >= longest && number(&draw["total"]) <= total, "{draw}");
        }
    }
}

#[test]
fn a_case_by_its_rates() {
    // The rates model uses no guessed figure, so scaling a guess does not change its tables.
    let ran = crossbar(&["timeline", "fixtures/cases/modulate.toml", "--sensitivity"], "");
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""));
    insta::assert_snapshot!(ran.stdout.split("\nModel pipeline").next().expect("the model of rates comes first"));
}

#[test]
fn every_case_has_a_time_in_both_models() {
    for name in CASES.iter() {
        let device = if ["mipmaps", "opengl_nv"].contains(&name.as_str()) { "nv30" } else { "r300" };
        let document = document(&["timeline", &example(name), "--device", device]);
        check(&document, &["rates", "pipeline"]);
        assert_eq!(document["device"], device, "{name}");
        assert_eq!(document["models"][1]["draws"].as_array().map(Vec::len), Some(1), "{name}");
    }
}

#[test]
fn buckets_follow_one_another_on_one_card() {
    let timed = document(RAYS);
    check(&timed, &["rates", "pipeline"]);
    assert_eq!((&timed["rays"], &timed["device"]), (&Value::from(33 * 2), &Value::from("r200")));
    // 32 x 32 rays per bucket, fewer at the edges: two buckets.
    assert!(timed["models"][0]["draws"].as_array().is_some_and(|draws| draws.len() >= 2), "{timed}");
    assert_eq!(document(&[RAYS, &["--threads", "3"]].concat()), timed, "the same for any number of threads");
}

fn whole(value: &Value) -> u64 {
    value.as_u64().unwrap_or_else(|| panic!("expected a whole number, found {value}"))
}

/// Slice of a lane; times in nanoseconds, as viewers round them.
struct Slice {
    name: String,
    category: String,
    start: u64,
    end: u64,
    end_ps: u64,
}

/// Events of a trace in one phase of the trace event format.
fn events<'t>(trace: &'t Value, phase: &'t str) -> impl Iterator<Item = &'t Value> {
    trace["traceEvents"].as_array().expect("events").iter().filter(move |event| event["ph"] == phase)
}

/// Lanes of a trace, from the top. Checks what viewers require: slices that do not overlap after Perfetto's rounding of
/// starts and durations, and flows whose ends lie in slices.
fn lanes(trace: &Value) -> Vec<(&str, Vec<Slice>)> {
    let text = |value: &'_ Value| value.as_str().expect("text").to_owned();
    let rounded = |value: &Value| (value.as_f64().expect("microseconds") * 1e3).round() as u64;
    let threads = events(trace, "M").filter(|event| event["name"] == "thread_name");
    let mut lanes: Vec<(&str, Vec<Slice>)> =
        threads.map(|event| (event["args"]["name"].as_str().expect("a name"), Vec::new())).collect();
    let lane = |event: &Value| whole(&event["tid"]) as usize - 1;
    for event in events(trace, "X") {
        let [start, length] = ["ts", "dur"].map(|key| rounded(&event[key]));
        let [start_ps, length_ps] = ["start_ps", "duration_ps"].map(|key| whole(&event["args"][key]));
        let (end, end_ps) = (start + length, start_ps + length_ps);
        assert_eq!([start, end], [start_ps / 1000, end_ps / 1000], "{event}");
        let slices = &mut lanes[lane(event)].1;
        assert!(slices.last().is_none_or(|before| before.end <= start), "two at a time: {event}");
        slices.push(Slice { name: text(&event["name"]), category: text(&event["cat"]), start, end, end_ps });
    }
    for flow in events(trace, "s").chain(events(trace, "f")) {
        let at = rounded(&flow["ts"]);
        assert!(lanes[lane(flow)].1.iter().any(|slice| (slice.start..=slice.end).contains(&at)), "{flow}");
    }
    lanes
}

#[test]
fn the_trace_is_one_that_viewers_open() {
    for arguments in [&["timeline", "fixtures/cases/modulate.toml"], RAYS] {
        let folder = tempfile::tempdir().expect("a folder for the test");
        let path = folder.path().join("trace.json");
        let path = path.to_str().expect("a path of text");
        let document = document(&[arguments, &["--perfetto", path]].concat());
        assert_eq!(document["trace"], path);
        let total = number(&document["totals"].as_array().and_then(|all| all.last()).expect("a model")["total"]);
        let trace: Value = serde_json::from_str(&fs::read_to_string(path).expect("the trace")).expect("JSON");
        let lanes = lanes(&trace);
        let names: Vec<&str> = lanes.iter().map(|(name, _)| *name).collect();
        assert_eq!(names, ["host", "upload bus", "front end", "shader array", "memory", "read-back bus"]);
        let process = events(&trace, "M").find(|event| event["name"] == "process_name").expect("a process");
        assert!(process["args"]["name"].as_str().is_some_and(|name| name.contains("(pipeline model)")), "{process}");
        let makespan = whole(&trace["otherData"]["makespan_ps"]);
        assert_same(makespan as f64 / 1e6, total, &"the length of the run");
        let slices = || lanes.iter().flat_map(|(_, slices)| slices);
        assert_eq!(slices().map(|slice| slice.end_ps).max(), Some(makespan), "the last slice ends with the run");
        assert!(slices().any(|slice| slice.category == "wait") && slices().any(|slice| slice.name == "draw 0"));
        assert!(events(&trace, "s").count() > 0, "the critical path goes from unit to unit");
    }
}
