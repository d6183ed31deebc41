//! `crossbar timeline`: tables, document and trace of a run, and messages for invalid requests.

use std::fs;

use serde_json::Value;

use crate::answers::{document, number};
use crate::case::{CASES, example};
use crate::trace_format::{Shown, read};
use crate::{crossbar, crossbar_in};

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
    for name in CASES {
        let device = if ["mipmaps", "opengl_nv"].contains(name) { "nv30" } else { "r300" };
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

#[test]
fn guesses_are_halved_and_doubled() {
    let document = document(&["timeline", "fixtures/cases/modulate.toml", "--sensitivity"]);
    let model = &document["models"][1];
    let total = number(&document["totals"][1]["total"]);
    let rows = model["sensitivity"].as_array().expect("rows");
    let row = |key: &str| rows.iter().find(|row| row["guess"] == key).unwrap_or_else(|| panic!("no guess {key}"));
    // With four pixels, the host takes longer to submit the draw than the card to execute it.
    let draw = row("queue.draw_ps");
    assert!(number(&draw["halved"]) < total && total < number(&draw["doubled"]), "{draw}");
    let unused = row("queue.finish_fence_ps");
    assert_eq!([&unused["halved"], &unused["doubled"]].map(number), [total, total]);
    assert!(rows.iter().any(|row| row["guess"].as_str().is_some_and(|key| key.starts_with("bus."))));
}

#[test]
fn the_texture_cache_on_request() {
    let estimated = document(RAYS);
    assert!(estimated["texture_cache"].is_null());
    let simulated = document(&[RAYS, &["--cache"]].concat());
    check(&simulated, &["rates", "pipeline"]);
    let rows = simulated["texture_cache"].as_array().expect("rows");
    assert!(!rows.is_empty());
    for row in rows {
        let figures = ["texels", "misses_half", "misses", "misses_double", "distinct_lines"];
        let [texels, half, same, double, distinct] = figures.map(|figure| number(&row[figure]));
        assert!(texels > 0.0 && texels >= half, "{row}");
        assert!(half >= same && same >= double && double >= distinct && distinct > 0.0, "{row}");
    }
    // The work is equal under both models of cache misses.
    assert_eq!(sum(&estimated["models"][0]["draws"], "fragments"), sum(&simulated["models"][0]["draws"], "fragments"));
}

fn traced(arguments: &[&str]) -> (Shown, f64) {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let path = folder.path().join("trace.json");
    let path = path.to_str().expect("a path of text");
    let document = document(&[arguments, &["--perfetto", path]].concat());
    assert_eq!(document["trace"], path);
    let totals = document["totals"].as_array().expect("totals");
    let total = number(&totals.last().expect("a model")["total"]);
    let shown = read(&fs::read_to_string(path).expect("the trace")).expect("a good trace");
    (shown, total)
}

#[test]
fn the_trace_is_one_that_viewers_open() {
    for arguments in [&["timeline", "fixtures/cases/modulate.toml"], RAYS] {
        let (shown, total) = traced(arguments);
        let names: Vec<&str> = shown.threads.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["host", "upload bus", "front end", "shader array", "memory", "read-back bus"]);
        assert!(shown.process.contains("(pipeline model)"), "{}", shown.process);
        assert_same(number(&shown.about["makespan_ps"]) / 1e6, total, &"the length of the run");
        let slices = || shown.threads.iter().flat_map(|(_, slices)| slices);
        let end = slices().map(|slice| slice.end_ps).max().unwrap_or_default();
        assert_eq!(number(&shown.about["makespan_ps"]), end as f64, "the last slice ends with the run");
        assert!(slices().any(|slice| slice.category == "wait") && slices().any(|slice| slice.name == "draw 0"));
        assert!(shown.flows > 0, "the critical path goes from unit to unit");
    }
}

#[test]
fn bad_requests() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let case = example("modulate");
    for (name, arguments) in [
        ("no_time", vec!["timeline", &case, "--device", "ideal-fp32"]),
        ("unknown_device", vec!["timeline", &case, "--device", "r9999"]),
        ("nothing", vec!["timeline"]),
        ("case_and_rays", vec!["timeline", &case, "--eye-rays", "4x4"]),
        ("bad_rays", vec!["timeline", "--eye-rays", "4"]),
        ("no_kernel", vec!["timeline", "--eye-rays", "4x4", "--device", "nv20"]),
    ] {
        let ran = crossbar_in(folder.path(), &arguments, "");
        assert_eq!(ran.code, Some(2), "{name}: {}", ran.stdout);
        insta::assert_snapshot!(format!("bad_{name}"), ran.transcript().replace(&case, "modulate.toml"));
        assert_eq!(fs::read_dir(folder.path()).expect("the folder").count(), 0, "{name} leaves nothing behind");
    }
}
