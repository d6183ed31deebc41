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
    let slip = crossbar_in(folder.path(), &["reproduce", "cpca-figure7"], "");
    assert!(slip.stderr.contains("did you mean `cpca-figure-7`?"), "{}", slip.stderr);
}

/// A list computes nothing, so it has no folder and no size; an entry without a record has no run to repeat.
#[test]
fn options_without_effect_are_refused() {
    for (options, reason) in [
        (["--list", "--full-size"], "cannot be used with"),
        (["--list", "--out=found"], "cannot be used with"),
        (["cpca-appendix", "--full-size"], "expected a recorded entry"),
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        let ran = crossbar_in(folder.path(), &[&["reproduce"], &options[..]].concat(), "");
        assert_eq!(ran.code, Some(2), "{options:?}: {}", ran.stdout);
        assert!(ran.stderr.contains(reason), "{options:?}: {}", ran.stderr);
    }
}

/// Snapshot of the figures, which reveals changes of the model.
#[test]
fn the_rows_are_these() {
    let folder = tempfile::tempdir().expect("a folder");
    // The tables of complete renderings take long; tests/papers covers them.
    let quick =
        ["ray-engine-radeon-8500", "ray-engine-vertex-variant", "ray-engine-equation-11", "ray-engine-figure-7"];
    let ran = crossbar_in(folder.path(), &[&["reproduce", "--json", "--out", "found"], &quick[..]].concat(), "");
    assert_eq!(ran.code, Some(0), "a missed figure is no failure: {}", ran.stderr);
    let document = ran.json();
    assert_eq!(document["rows"].as_array().map(Vec::len), Some(8));
    let tally = document["tally"].as_array().expect("a tally");
    let counted: u64 = tally.iter().filter_map(|row| row["rows"].as_u64()).sum();
    assert_eq!(counted, 8, "every row has one verdict: {tally:?}");
    let file = |name: &str| std::fs::read_to_string(folder.path().join("found").join(name)).expect("it was written");
    assert!(file("index.html").contains("<svg") && file("ray-engine-figure-7-gamma-4.svg").starts_with("<svg"));
    let written: serde_json::Value = serde_json::from_str(&file("study.json")).expect("JSON");
    assert_eq!(written["rows"], document["rows"]);
    insta::assert_snapshot!(file("rows.csv") + &file("tally.csv"));
}

/// Recording continues where it was interrupted: an existing file stays unchanged.
#[test]
fn what_is_recorded_stays() {
    let folder = tempfile::tempdir().expect("a folder");
    let kept = folder.path().join("cpca-figure-6.toml");
    std::fs::write(&kept, "a record").expect("a file");
    let entries = ["cpca-section-6", "cpca-figure-6"];
    let ran = crossbar_in(folder.path(), &[&["reproduce", "--record", ".", "--json"], &entries[..]].concat(), "");
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let document = ran.json();
    let records = document["records"].as_array().expect("records").iter();
    let records: Vec<_> = records.map(|record| (record["entry"].clone(), record["record"].clone())).collect();
    assert_eq!(records, [(entries[0].into(), "new".into()), (entries[1].into(), "kept".into())]);
    assert_eq!(std::fs::read_to_string(&kept).expect("the file"), "a record");
    let new = std::fs::read_to_string(folder.path().join("cpca-section-6.toml")).expect("a record");
    assert!(new.contains("command = \"crossbar reproduce cpca-section-6 --full-size\""), "{new}");
}

/// Each row names its run: the table, CSV and JSON mark recorded rows, and the page says how they were recorded.
#[test]
fn recorded_rows_say_so() {
    let folder = tempfile::tempdir().expect("a folder");
    let entries = ["cpca-figure-6", "ray-engine-equation-11"];
    let ran = crossbar_in(folder.path(), &[&["reproduce", "--json", "--out", "found"], &entries[..]].concat(), "");
    let document = ran.json();
    for row in document["rows"].as_array().expect("rows") {
        let is_recorded = row["entry"] == "cpca-figure-6";
        assert_eq!(row["source"], if is_recorded { "recorded" } else { "computed" }, "{row}");
    }
    let commit = document["entries"].as_array().expect("entries").iter().find_map(|it| it["record"]["commit"].as_str());
    let page = std::fs::read_to_string(folder.path().join("found/index.html")).expect("a page");
    assert!(page.contains("Rows and tables are recorded: ") && page.contains(commit.expect("a commit")));
    assert!(page.contains("Recorded at full size: 1."), "the conclusion counts them");
    let csv = std::fs::read_to_string(folder.path().join("found/rows.csv")).expect("rows");
    assert_eq!(csv.lines().filter(|line| line.contains(",recorded,")).count(), 1);
}
