//! Records of runs at full size belong to the entries that the program has.
//!
//! A run on reduced models proves that an entry ends and has the rows and tables of its record. `CROSSBAR_FULL=1` runs
//! all recorded entries, and the fastest of them at full size. By default one entry runs on reduced models: entry
//! number `CROSSBAR_TURN`, which otherwise depends on the day.

use std::env;
use std::io::Write as _;
use std::time::SystemTime;

use crossbar::report::Table;
use crossbar::study::reproduce::{
    ENTRIES, EntryFindings, PaperRow, RecordStatus, ReproduceEntry, RowSource, recorded, reproduce,
};

use super::{FOUND, file, findings};
use crate::environment::is_full;

fn with_record() -> Vec<&'static ReproduceEntry> {
    ENTRIES.iter().filter(|entry| recorded(entry).expect("whole records").is_some()).collect()
}

fn in_this_form() -> Vec<&'static ReproduceEntry> {
    let records = with_record();
    if is_full() {
        return records;
    }
    let today = || SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).expect("a clock").as_secs() / 86_400;
    let turn = env::var("CROSSBAR_TURN").map_or_else(|_| today(), |turn| turn.parse().expect("a number of a turn"));
    let chosen = records[turn as usize % records.len()];
    // Writes directly, since the test harness captures the output of passing tests.
    _ = writeln!(std::io::stderr(), "of the recorded entries, {} is run: CROSSBAR_TURN={turn}", chosen.id);
    vec![chosen]
}

#[test]
fn entries_have_the_rows_and_tables_of_their_records() {
    let rows = |found: &EntryFindings| -> Vec<_> {
        found.rows.iter().map(|row: &PaperRow| (row.target.id.clone(), row.device, row.dependence)).collect()
    };
    let table = |table: &Table| [table.title(), &table.headings().join(" ")].map(str::to_owned);
    for entry in in_this_form() {
        let (record, reduced) = (findings(entry.id), entry.on_reduced_models().expect("a run"));
        assert_eq!(rows(&reduced), rows(record), "{}", entry.id);
        let tables = |found: &EntryFindings| found.tables.iter().map(table).collect::<Vec<_>>();
        assert_eq!(tables(&reduced), tables(record), "{}", entry.id);
        assert_eq!((reduced.text.len(), &reduced.questions), (record.text.len(), &record.questions), "{}", entry.id);
    }
}

/// With `CROSSBAR_FULL=1`, the fastest record is reproduced bit for bit.
#[test]
fn the_quickest_record_comes_out_again() {
    if !is_full() {
        return;
    }
    let seconds = |entry: &&ReproduceEntry| recorded(entry).ok()??.made.processor_s;
    let timed = with_record().into_iter().filter_map(|entry| Some((seconds(&entry)?, *entry)));
    let (_, entry) = timed.min_by(|a, b| a.0.total_cmp(&b.0)).expect("a record");
    let found = reproduce(&[entry], true, &mut |_, _, _| ()).expect("it can be worked out");
    let drawn = found[0].1.rows.iter().filter(|row| row.target.equation.is_none());
    assert!(drawn.map(|row| row.source).all(|source| source == RowSource::Confirmed), "{}", entry.id);
}

/// Every file of the folder is the record of an entry, and the findings and rows of the entry name it.
#[test]
fn every_file_is_the_record_of_an_entry() {
    let files = std::fs::read_dir(file("src/studies/records")).expect("the records");
    let names = files.map(|file| file.expect("a file").file_name().into_string().expect("a name in ASCII"));
    let mut names: Vec<String> = names.filter_map(|name| Some(name.strip_suffix(".toml")?.to_owned())).collect();
    names.sort();
    let mut known: Vec<&str> = with_record().iter().map(|entry| entry.id).collect();
    known.sort_unstable();
    assert_eq!(names, known);
    for (entry, found) in FOUND.iter() {
        let is_recorded = known.contains(&entry.id);
        assert_eq!(matches!(found.record, Some(RecordStatus::Recorded(_))), is_recorded, "{}", entry.id);
        for row in &found.rows {
            let source =
                if is_recorded && row.target.equation.is_none() { RowSource::Recorded } else { RowSource::Computed };
            assert_eq!(row.source, source, "{}", row.target.id);
        }
    }
}
