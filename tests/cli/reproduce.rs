//! `crossbar reproduce`.

use crate::{crossbar, crossbar_in};

#[test]
fn the_list_says_what_there_is() {
    insta::assert_snapshot!(crossbar(&["reproduce", "--list"], "").transcript());
}

#[test]
fn an_unknown_entry_is_refused_before_anything_is_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let ran = crossbar_in(folder.path(), &["reproduce", "table-9"], "");
    assert_eq!(std::fs::read_dir(folder.path()).expect("it is there").count(), 0);
    insta::assert_snapshot!(ran.transcript());
    let slip = crossbar_in(folder.path(), &["reproduce", "figure7"], "");
    assert!(slip.stderr.contains("did you mean `figure-7`?"), "{}", slip.stderr);
}

/// Snapshot of the figures: a change of the model shows here.
#[test]
fn the_rows_are_these() {
    let folder = tempfile::tempdir().expect("a folder");
    // The tables of complete renderings take long; tests/papers covers them.
    let quick = ["radeon-8500", "vertex-variant", "equation-11", "figure-7"];
    let ran = crossbar_in(folder.path(), &[&["reproduce", "--json", "--out", "found"], &quick[..]].concat(), "");
    assert_eq!(ran.code, Some(1), "figures are missed: {}", ran.stderr);
    let document: serde_json::Value = serde_json::from_str(&ran.stdout).expect("JSON");
    assert_eq!(document["rows"].as_array().map(Vec::len), Some(7));
    let tally = document["tally"].as_array().expect("a tally");
    let counted: u64 = tally.iter().filter_map(|row| row["rows"].as_u64()).sum();
    assert_eq!(counted, 7, "every row has one verdict: {tally:?}");
    let file = |name: &str| std::fs::read_to_string(folder.path().join("found").join(name)).expect("it was written");
    assert!(file("index.html").contains("<svg") && file("figure-7-gamma-4.svg").starts_with("<svg"));
    let written: serde_json::Value = serde_json::from_str(&file("study.json")).expect("JSON");
    assert_eq!(written["rows"], document["rows"]);
    insta::assert_snapshot!(file("rows.csv") + &file("tally.csv"));
}

/// Exit code 0 and a text that says so, when every row holds.
#[test]
fn nothing_missed_is_success() {
    let folder = tempfile::tempdir().expect("a folder");
    let ran = crossbar_in(folder.path(), &["reproduce", "equation-11", "--out", "found"], "");
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    insta::assert_snapshot!(ran.stdout);
}
