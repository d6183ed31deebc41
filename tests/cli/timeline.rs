//! `crossbar timeline`: tables, document and trace of a run, and messages for invalid requests.

use std::fs;

use serde_json::Value;

use crate::answers::document;
use crate::case::{CASES, example};
use crate::trace_format::{Shown, read};
use crate::{crossbar, crossbar_in};

/// A small crossbar.
const RAYS: &[&str] = &["timeline", "--eye-rays", "48x40", "--mesh", "fixtures/models/square.obj"];

fn number(value: &Value) -> u64 {
    value.as_u64().unwrap_or_else(|| panic!("expected a whole number, found {value}"))
}

fn sum(list: &Value, field: &str) -> u64 {
    list.as_array().expect("a list").iter().map(|entry| number(&entry[field])).sum()
}

/// Checks relations between the figures of a document.
fn check(document: &Value, models: &[&str]) {
    let found: Vec<&str> =
        document["models"].as_array().expect("models").iter().map(|m| m["model"].as_str().expect("a name")).collect();
    assert_eq!(found, models);
    for model in document["models"].as_array().expect("models") {
        let total = number(&model["total_ps"]);
        assert!(total > 0);
        assert_eq!(sum(&model["critical_path"], "time_ps"), total, "the path is the whole run");
        for unit in model["units"].as_array().expect("units") {
            let parts = ["busy_ps", "waiting_ps", "idle_ps"].map(|part| number(&unit[part]));
            assert_eq!(parts.iter().sum::<u64>(), total, "{unit}");
        }
        for draw in model["draws"].as_array().expect("draws") {
            let longest = ["front_end_ps", "shader_ps", "memory_ps"].map(|part| number(&draw[part])).into_iter().max();
            assert!(Some(number(&draw["total_ps"])) >= longest && number(&draw["total_ps"]) <= total, "{draw}");
        }
    }
}

#[test]
fn a_case_by_its_rates() {
    // The rates model uses no guessed figure, so scaling a guess does not change its tables.
    let ran = crossbar(&["timeline", "fixtures/cases/modulate.toml", "--timing", "rates", "--sensitivity"], "");
    insta::assert_snapshot!(ran.transcript());
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
    assert_eq!((&timed["rays"], &timed["device"]), (&Value::from(48 * 40), &Value::from("r200")));
    // 32 x 32 rays per bucket, fewer at the edges: four buckets.
    assert_eq!(timed["models"][0]["draws"].as_array().map(Vec::len), Some(4));
    assert_eq!(document(&[RAYS, &["--threads", "3"]].concat()), timed, "the same for any number of threads");
}

fn traced(arguments: &[&str]) -> (Shown, u64) {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let path = folder.path().join("trace.json");
    let path = path.to_str().expect("a path of text");
    let document = document(&[arguments, &["--perfetto", path]].concat());
    assert_eq!(document["trace"], path);
    let models = document["models"].as_array().expect("models");
    let total = number(&models.last().expect("a model")["total_ps"]);
    let shown = read(&fs::read_to_string(path).expect("the trace"));
    (shown, total)
}

#[test]
fn the_trace_is_one_that_viewers_open() {
    for arguments in [&["timeline", "fixtures/cases/modulate.toml"], RAYS] {
        let (shown, total) = traced(arguments);
        let names: Vec<&str> = shown.threads.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["host", "upload bus", "front end", "shader array", "memory", "read-back bus"]);
        assert!(shown.process.contains("(pipeline model)"), "{}", shown.process);
        assert_eq!(number(&shown.about["makespan_ps"]), total);
        let slices = || shown.threads.iter().flat_map(|(_, slices)| slices);
        assert_eq!(slices().map(|slice| slice.end_ps).max(), Some(total), "the last slice ends with the run");
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
        ("mesh_of_a_case", vec!["timeline", &case, "--mesh", "m.obj"]),
        ("bad_rays", vec!["timeline", "--eye-rays", "4"]),
        ("no_kernel", vec!["timeline", "--eye-rays", "4x4", "--device", "nv20"]),
    ] {
        let ran = crossbar_in(folder.path(), &arguments, "");
        assert_eq!(ran.code, Some(2), "{name}: {}", ran.stdout);
        insta::assert_snapshot!(format!("bad_{name}"), ran.transcript().replace(&case, "modulate.toml"));
        assert_eq!(fs::read_dir(folder.path()).expect("the folder").count(), 0, "{name} leaves nothing behind");
    }
}
