//! Tests the program with an adapter: the list of adapters, and cases compared with the other executors.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use refsim::exec::gpu::Gpu;
use serde_json::Value;

use crate::program::{crossbar, crossbar_in};

/// The program's output as JSON; drivers may write to standard error.
fn document(text: &str) -> Value {
    serde_json::from_str(text).expect("one JSON document")
}

pub(crate) fn adapters_are_listed(_: &Arc<Gpu>) {
    let ran = crossbar(&["devices", "--adapters", "--json"], "");
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let listed = document(&ran.stdout);
    let adapters = listed.as_array().expect("a list");
    assert!(!adapters.is_empty());
    let text = crossbar(&["devices", "--adapters"], "").stdout;
    for adapter in adapters {
        let name = adapter["name"].as_str().expect("a name");
        assert!(text.contains(name.split_whitespace().next().unwrap_or_default()), "{name} is not in\n{text}");
        assert!(adapter["largest_buffer"].as_u64().expect("bytes") >= 1 << 27);
    }
}

pub(crate) fn every_example_is_equal_down_to_its_instructions(_: &Arc<Gpu>) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/cases");
    let cases = fs::read_dir(folder).expect("the folder of the examples").flatten().map(|entry| entry.path());
    let cases: Vec<_> = cases.filter(|path| path.extension().is_some_and(|ending| ending == "toml")).collect();
    assert!(!cases.is_empty());
    for case in cases {
        let case = case.to_str().expect("a path that is text");
        let folder = tempfile::tempdir().expect("a folder for the test");
        let ran = crossbar_in(folder.path(), &["compare", case, "--right", "wgpu", "--pixel", "1,1"], "");
        assert_eq!(ran.code, Some(0), "{case}: {}", ran.transcript());
        let trace = |executor| {
            let arguments = ["run", case, "--executor", executor, "--trace", "1,1", "--json"];
            let ran = crossbar_in(folder.path(), &arguments, "");
            assert_eq!(ran.code, Some(0), "{case}: {}", ran.transcript());
            document(&ran.stdout)["trace"].clone()
        };
        assert_eq!(trace("wgpu"), trace("batch"), "{case}");
    }
}

pub(crate) fn the_first_instruction_that_differs_is_named(_: &Arc<Gpu>) {
    let folder = tempfile::tempdir().expect("a folder for the test");
    fs::write(folder.path().join("case.toml"), include_str!("../cli/two_roundings.toml")).expect("a file");
    let first = |arguments: &[&str]| {
        let all = [&["compare", "case.toml", "--json", "--right-format", "s3.12:rtz"], arguments].concat();
        let ran = crossbar_in(folder.path(), &all, "");
        assert_eq!(ran.code, Some(1), "{}", ran.transcript());
        document(&ran.stdout)["first"].clone()
    };
    let wanted = first(&[]);
    assert_eq!(wanted["difference"]["instruction"]["source"]["text"], "mul r0, r1, c1");
    assert_eq!(first(&["--left", "wgpu", "--right", "wgpu"]), wanted);
    assert_eq!(first(&["--right", "wgpu"]), wanted);
}
