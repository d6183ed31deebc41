//! The papers' figures beside ours, all worked out once.

mod book;
mod entries;
mod pictures;
mod printed;
mod verdicts;

use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use crossbar::study::reproduce::{ENTRIES, EntryFindings, ModelSize, PaperRow, Reproduced, reproduce};

/// Worked out once.
static FOUND: LazyLock<Reproduced> =
    LazyLock::new(|| reproduce(ENTRIES, ModelSize::Reduced, &mut |_, _, _| ()).expect("the entries can be worked out"));

fn all() -> impl Iterator<Item = &'static PaperRow> {
    FOUND.iter().flat_map(|(_, found)| &found.rows)
}

fn findings(id: &str) -> &'static EntryFindings {
    &FOUND.iter().find(|(entry, _)| entry.id == id).expect("an entry").1
}

fn file(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}
