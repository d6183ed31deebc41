//! The papers' figures beside ours, all worked out once.
//!
//! Entries with records take most of the time: their runs on reduced models only prove that the records are of this
//! program. The full form has all of them, and so has a run that writes the pages; the short form has one by turns,
//! that of number `CROSSBAR_TURN`, by default of the day.

mod book;
mod entries;
mod pictures;
mod printed;
mod verdicts;

use std::env;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use std::time::SystemTime;

use crossbar::study::reproduce::{
    ENTRIES, EntryFindings, ModelSize, PaperRow, ReproduceEntry, Reproduced, recorded, reproduce,
};

use crate::environment::{is_full, writes_files};

/// Worked out once.
static FOUND: LazyLock<Reproduced> = LazyLock::new(|| {
    reproduce(&chosen(), ModelSize::Reduced, &mut |_, _, _| ()).expect("the entries can be worked out")
});

fn has_record(entry: &ReproduceEntry) -> bool {
    recorded(entry).expect("a whole record").is_some()
}

fn chosen() -> Vec<ReproduceEntry> {
    if is_full() || writes_files() {
        return ENTRIES.to_vec();
    }
    let records: Vec<&ReproduceEntry> = ENTRIES.iter().filter(|entry| has_record(entry)).collect();
    let today = || SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).expect("a clock").as_secs() / 86_400;
    let turn = env::var("CROSSBAR_TURN").map_or_else(|_| today(), |turn| turn.parse().expect("a number of a turn"));
    let turn = turn as usize % records.len();
    let chosen = records[turn].id;
    // Past the capture of tests that pass.
    _ = writeln!(std::io::stderr(), "of the recorded entries, {chosen} is run on reduced models: CROSSBAR_TURN={turn}");
    ENTRIES.iter().filter(|entry| entry.id == chosen || !has_record(entry)).copied().collect()
}

fn is_all() -> bool {
    FOUND.len() == ENTRIES.len()
}

fn all() -> impl Iterator<Item = &'static PaperRow> {
    FOUND.iter().flat_map(|(_, found)| &found.rows)
}

/// Findings of an entry; `None` if the short form leaves it out.
fn found(id: &str) -> Option<&'static EntryFindings> {
    let entry = ENTRIES.iter().find(|entry| entry.id == id).expect("an entry");
    let found = FOUND.iter().find(|(entry, _)| entry.id == id).map(|(_, found)| found);
    assert!(found.is_some() || has_record(entry), "{id} is left out");
    found
}

/// Findings of an entry without record.
fn findings(id: &str) -> &'static EntryFindings {
    found(id).expect("an entry without record")
}

/// Figures of the entries that are left out.
fn left_out() -> Vec<String> {
    let out = ENTRIES.iter().filter(|entry| found(entry.id).is_none());
    let records = out.map(|entry| recorded(entry).expect("a whole record").expect("a record"));
    records.flat_map(|record| record.figures().map(str::to_owned).collect::<Vec<_>>()).collect()
}

/// Row of a figure; `None` if the short form leaves its entry out.
fn row(id: &str) -> Option<&'static PaperRow> {
    let row = all().find(|row| row.target.id == id);
    assert!(row.is_some() || left_out().iter().any(|figure| figure == id), "no row judges {id}");
    row
}

fn file(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}
