//! Tables of every command, at terminal widths.

use std::path::Path;
use std::process::Command;

use unicode_width::UnicodeWidthStr as _;

use crate::crossbar_in;

/// The output of a command on a terminal of `columns` columns.
fn printed(folder: &Path, arguments: &[&str], columns: usize) -> String {
    let mut command = Command::new(crate::program::path());
    command.args(arguments).current_dir(folder).env("COLUMNS", columns.to_string());
    let output = command.output().expect("the program that this test was built with");
    String::from_utf8(output.stdout).expect("the program writes text")
}

/// Commands without a page print titled tables, and one line per written file; JSON names the same files.
#[test]
fn findings_without_a_page_are_text_or_fields() {
    type Fields<'a> = &'a [(&'a str, Option<&'a str>)];
    let quarters = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/examples/quarters.mtx").display().to_string();
    let light: &[&str] = &["all-frequency", "lighting", "--keep", "40", "--out", "light.csv"];
    let lists: &[&str] = &["bi-scale", "bicluster", &quarters, "--out", "lists.npz"];
    let patch: &[&str] =
        &["bi-scale", "texture", "bumps", "--texels", "4", "--directions", "2", "--views", "2", "--out", "bumps.npy"];
    let cases: [(_, _, Fields<'_>); 3] = [
        (light, "a clear sky with a sun in 24 segments\n|", &[("out", Some("light.csv"))]),
        (lists, "Biclusters\n|", &[("out", Some("lists.npz"))]),
        (patch, "patch     4 x 4 texels", &[("out", Some("bumps.npy")), ("sheet", None)]),
    ];
    let folder = tempfile::tempdir().expect("a folder for the test");
    for (arguments, beginning, files) in cases {
        let text = crossbar_in(folder.path(), arguments, "").stdout;
        assert!(text.starts_with(beginning), "{arguments:?}: {text}");
        let json = crossbar_in(folder.path(), &[arguments, &["--json"]].concat(), "").stdout;
        let document: serde_json::Value = serde_json::from_str(&json).expect("one JSON document");
        for (field, file) in files {
            assert_eq!(document.get(*field), Some(&serde_json::json!(file)), "{arguments:?}: {json}");
            let is_named = |file: &str| text.lines().any(|line| line == format!("written   {file}"));
            assert!(file.is_none_or(is_named), "{arguments:?}: {text}");
        }
        assert!(!text.ends_with("\n\n"), "{arguments:?}: {text}");
    }
}

/// `leaky-teapot` folds rows of switches that change nothing, also on its page; CSV and JSON have every row.
#[test]
fn rows_of_the_same_bits_are_folded() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let arguments = ["leaky-teapot", "--size", "32x32", "--tessellation", "2", "--rays-per-edge", "0"];
    insta::assert_snapshot!("leaky_teapot_80", printed(folder.path(), &arguments, 80));
    let file =
        |name: &str| std::fs::read_to_string(folder.path().join("out/leaky-teapot").join(name)).expect("written");
    let csv = file("rows.csv");
    assert!(file("index.html").contains("switches: the same bits"));
    let document: serde_json::Value = serde_json::from_str(&file("study.json")).expect("JSON");
    let rows = document["rows"].as_array().expect("rows").len();
    assert_eq!(csv.lines().count(), 1 + rows, "{csv}");
}

/// Without a terminal the output has a fixed form: tables at most 100 columns wide, progress without control
/// characters.
#[test]
fn off_a_terminal_the_width_is_fixed() {
    let ran = crossbar_in(Path::new(env!("CARGO_MANIFEST_DIR")), &["devices", "nv20"], "");
    assert!(ran.stdout.lines().all(|line| line.width() <= 100), "{}", ran.stdout);
    assert!(!ran.stdout.contains('\x1b') && !ran.stderr.contains(['\x1b', '\r']));
}
