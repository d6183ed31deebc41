//! Compares the papers' figures with ours, which are computed once.

mod book;
mod entries;
mod printed;
mod records;
mod verdicts;

use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use crossbar::study::reproduce::{ENTRIES, EntryFindings, PaperRow, Reproduced, reproduce};

/// All findings, computed once.
static FOUND: LazyLock<Reproduced> =
    LazyLock::new(|| reproduce(ENTRIES, false, &mut |_, _, _| ()).expect("the entries can be worked out"));

fn all() -> impl Iterator<Item = &'static PaperRow> {
    FOUND.iter().flat_map(|(_, found)| &found.rows)
}

fn findings(id: &str) -> &'static EntryFindings {
    &FOUND.iter().find(|(entry, _)| entry.id == id).expect("an entry").1
}

/// Row of a figure.
fn row(id: &str) -> &'static PaperRow {
    all().find(|row| row.target.id == id).unwrap_or_else(|| panic!("no row judges {id}"))
}

fn file(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}
