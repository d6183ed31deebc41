//! `crossbar precision`: other commands accept its device of mixed formats.

use std::fs;

use crate::commands::copy_of_the_repository;
use crate::crossbar_in;

#[test]
fn the_mixed_device_meets_the_goal_that_it_was_made_for() {
    let root = copy_of_the_repository();
    let run = |arguments: &[&str]| crossbar_in(root.path(), arguments, "");
    let found = run(&["precision", "docs/examples/lerp.toml", "--goal", "largest_codes<=0", "--out", "out", "--json"]);
    assert_eq!(found.code, Some(0), "{}", found.transcript());
    let document = found.json();
    assert_eq!(document["families"][0]["one_minimal"], true, "{document}");
    let device = fs::read_to_string(root.path().join("out/mixed.toml")).expect("a device");
    assert!(device.starts_with("device = \"nv25\"") && device.contains("# lrp r0, t0, c0, c1"), "{device}");
    let compared =
        "compare docs/examples/lerp.toml --left-device out/mixed.toml --right-device nv25 --right-format fp32";
    let compared = run(&compared.split(' ').collect::<Vec<_>>());
    assert_eq!(compared.code, Some(0), "{}", compared.transcript());
    // Formats of a changed program have no effect, and a warning says so.
    let case = fs::read_to_string(root.path().join("docs/examples/lerp.toml")).expect("a case");
    let changed = case.replace("\"nv25\"", "\"out/mixed.toml\"");
    fs::write(root.path().join("same.toml"), &changed).expect("a file");
    fs::write(root.path().join("changed.toml"), changed.replace("lrp r0, t0, c0, c1", "mul r0, t0, c0"))
        .expect("a file");
    let said = |case: &str| run(&["run", case, "--out", "drawn"]).stderr;
    assert_eq!(said("same.toml"), "");
    assert!(said("changed.toml").contains("which the case does not run"), "{}", said("changed.toml"));
    // Neither have formats of storages that the program does not use.
    let device = "device = \"ideal-fp32\"\n[storage]\nconstants = \"e5m2\"\ncolors = \"e5m2\"\n";
    fs::write(root.path().join("storing.toml"), device).expect("a file");
    fs::write(root.path().join("stored.toml"), case.replace("\"nv25\"", "\"storing.toml\"")).expect("a file");
    let warning = said("stored.toml");
    assert!(warning.contains("a format for colors, which the pixel program does not use"), "{warning}");
    assert!(!warning.contains("constants"), "{warning}");
    let shown = run(&["devices", "storing.toml"]).stdout;
    assert!(shown.contains("Formats of stored values and of sums") && shown.contains("| constants | e5m2"), "{shown}");
}

#[test]
fn expressions_are_studied_and_listed() {
    let root = copy_of_the_repository();
    let run =
        |arguments: &[&str]| crossbar_in(root.path(), &[&["precision", "--samples", "60"], arguments].concat(), "");
    let one = run(&["--expr", "-x/3 + x*x", "--range", "x=-1..1", "--json", "--out", "one"]);
    assert_eq!(one.code, Some(0), "{}", one.transcript());
    let document = one.json();
    assert_eq!(document["formats"][0]["format"], "e4m3", "{document}");
    assert_eq!(document["provenance"]["seed"], 0, "{document}");
    assert!(root.path().join("one/index.html").exists() && root.path().join("one/operations.csv").exists());
    let all = run(&["--fpcore", "fixtures/fpbench/suite.fpcore", "--out", "all", "--json"]);
    let document = all.json();
    assert_eq!(document["expressions"].as_array().map(Vec::len), Some(32), "{document}");
    assert_eq!(document["not_studied"][0]["place"], "109:3", "{document}");
}

/// The shader with expressions in f16 differs from the exact one by one code, as the study states.
#[cfg(feature = "wgsl")]
#[test]
fn the_rewritten_shader_draws_what_the_study_states() {
    let root = copy_of_the_repository();
    let run = |arguments: &str| crossbar_in(root.path(), &arguments.split(' ').collect::<Vec<_>>(), "");
    let given = "fresnel.wgsl --uniform f0=0.04,0.3,0.9";
    let study = run(&format!("precision docs/examples/wgsl/{given} --family float --budget 75 --out out --json"));
    let document = study.json();
    let rows = document["half"].as_array().cloned().unwrap_or_default();
    let refuted: Vec<&serde_json::Value> = rows.iter().filter(|row| row["may_be_f16"] != "yes").collect();
    assert_eq!(rows.len(), 13, "{}", study.transcript());
    assert!(matches!(refuted[..], [row] if row["expression"] == "dot(xy, xy)"), "{refuted:?}");
    assert_eq!(refuted[0]["refuted_at_column_row"], "26, 0: red 205, not 212");
    assert_eq!(run(&format!("run docs/examples/wgsl/{given} --out exact")).code, Some(0));
    fs::rename(root.path().join("out/half.wgsl"), root.path().join("fresnel.wgsl")).expect("a shader");
    assert_eq!(run(&format!("run {given} --out half")).code, Some(0));
    for (largest, code) in [("0.00393", Some(0)), ("0.0039", Some(1))] {
        let diff = run(&format!("diff exact/target0.png half/target0.png --max-error {largest}"));
        assert_eq!(diff.code, code, "{}", diff.transcript());
    }
}
