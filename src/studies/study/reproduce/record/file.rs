//! Files of recorded runs.

use serde::{Deserialize, Serialize};

use super::cells::{coded, decoded};
use super::error::RecordError;
use super::inputs::RecordInputs;
use super::status::RecordMade;
use crate::report::{Table, sha256};
use crate::study::reproduce::{EntryFindings, PaperRow, Setting};

const HEAD: &str = "# A run at full size. `crossbar reproduce --record` writes this file; a value that is changed by hand is refused.\n";
const DIGEST: &str = "digest = ";

/// Recorded run of an entry at full size.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EntryRecord {
    /// Name of the entry.
    pub(super) entry: String,
    /// Numbers of its paragraphs.
    pub(super) text: Vec<Vec<String>>,
    /// How it was made.
    pub(super) made: RecordMade,
    /// Digests of what determines it.
    pub(super) inputs: RecordInputs,
    #[serde(default)]
    pub(super) row: Vec<RecordedRow>,
    #[serde(default)]
    pub(super) sweep: Vec<RecordedSweep>,
    #[serde(default)]
    table: Vec<RecordedTable>,
}

/// Values of a row.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RecordedRow {
    pub(super) figure: String,
    pub(super) ours: f64,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) readings: Vec<f64>,
    /// Values on reduced models: ours, then the readings.
    pub(super) reduced: Vec<f64>,
}

/// Values of rows at the settings of a sweep.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RecordedSweep {
    pub(super) name: String,
    pub(super) figures: Vec<String>,
    pub(super) setting: Vec<Setting>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct RecordedTable {
    title: String,
    headings: Vec<String>,
    /// Cells as text, row by row.
    row: Vec<RecordedCells>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct RecordedCells {
    cells: Vec<String>,
}

impl EntryRecord {
    /// Creates the record of a run at full size, with the run of the same program on reduced models.
    pub(super) fn new(entry: &str, inputs: RecordInputs, (full, reduced): (&EntryFindings, &EntryFindings)) -> Self {
        let row = |(row, smaller): (&PaperRow, &PaperRow)| RecordedRow {
            figure: row.target.id.clone(),
            ours: row.ours,
            readings: row.readings.clone(),
            reduced: smaller.values().collect(),
        };
        Self {
            entry: entry.to_owned(),
            text: full.text.iter().map(|paragraph| paragraph.figures().to_vec()).collect(),
            made: RecordMade::default(),
            inputs,
            row: full.rows.iter().zip(&reduced.rows).map(row).collect(),
            sweep: sweeps(&full.rows),
            table: full.tables.iter().map(RecordedTable::of).collect(),
        }
    }

    /// Adds how the record was made.
    #[must_use]
    pub fn made_by(self, made: RecordMade) -> Self {
        Self { made, ..self }
    }

    /// How the record was made.
    pub const fn made(&self) -> &RecordMade {
        &self.made
    }

    /// Names of the rows' figures.
    pub fn figures(&self) -> impl Iterator<Item = &str> {
        self.row.iter().map(|row| row.figure.as_str())
    }

    /// Number of rows.
    pub const fn len(&self) -> usize {
        self.row.len()
    }

    /// Returns `true` if no row is recorded.
    pub const fn is_empty(&self) -> bool {
        self.row.is_empty()
    }

    /// Formats the file.
    ///
    /// # Errors
    /// If the record cannot be written as TOML.
    pub fn text(&self) -> Result<String, RecordError> {
        let body = toml::to_string(self).map_err(|error| malformed(&self.entry, error.to_string()))?;
        Ok(format!("{HEAD}{DIGEST}\"{}\"\n{body}", digest(&body)))
    }

    /// Parses a file.
    ///
    /// # Errors
    /// If it is malformed, was changed by hand, or is the record of another entry.
    pub fn parse(entry: &str, text: &str) -> Result<Self, RecordError> {
        // Checkouts may end lines in another way.
        let text = text.replace('\r', "");
        let rest = text.strip_prefix(HEAD).unwrap_or(&text).strip_prefix(DIGEST);
        let parts = rest.and_then(|rest| rest.strip_prefix('"')?.split_once("\"\n"));
        let missing = || malformed(entry, format!("expected a line `{DIGEST}\"...\"` at its beginning"));
        let (stated, body) = parts.ok_or_else(missing)?;
        let found = digest(body);
        if found != stated {
            return Err(RecordError::Edited { entry: entry.to_owned(), stated: stated.to_owned(), found });
        }
        let record: Self = toml::from_str(body).map_err(|error| malformed(entry, error.to_string()))?;
        if record.entry != entry {
            return Err(RecordError::Entry { expected: entry.to_owned(), found: record.entry });
        }
        match record.table.iter().find_map(RecordedTable::no_cell) {
            Some(text) => Err(malformed(entry, format!("expected a cell of a table, found `{text}`"))),
            None => Ok(record),
        }
    }

    /// Tables of the run.
    pub(super) fn tables(&self) -> Vec<Table> {
        self.table.iter().map(RecordedTable::table).collect()
    }
}

impl RecordedTable {
    fn of(table: &Table) -> Self {
        let cells = |row: &Vec<_>| RecordedCells { cells: row.iter().map(coded).collect() };
        Self {
            title: table.title().to_owned(),
            headings: table.headings().to_vec(),
            row: table.rows().iter().map(cells).collect(),
        }
    }

    /// First text that is no cell.
    fn no_cell(&self) -> Option<&str> {
        let mut cells = self.row.iter().flat_map(|row| &row.cells);
        cells.find(|cell| decoded(cell).is_none()).map(String::as_str)
    }

    fn table(&self) -> Table {
        let mut table = Table::new(self.title.as_str(), &self.headings);
        for row in &self.row {
            table.push(row.cells.iter().filter_map(|cell| decoded(cell)));
        }
        table
    }
}

/// Sweeps of some rows, each once.
fn sweeps(rows: &[PaperRow]) -> Vec<RecordedSweep> {
    let mut found: Vec<RecordedSweep> = Vec::new();
    for applied in rows.iter().flat_map(PaperRow::swept) {
        if found.iter().all(|known| known.name != applied.name || known.figures != applied.figures) {
            found.push(RecordedSweep {
                name: applied.name.to_owned(),
                figures: applied.figures.clone(),
                setting: applied.settings.clone(),
            });
        }
    }
    found
}

fn malformed(entry: &str, reason: String) -> RecordError {
    RecordError::Malformed { entry: entry.to_owned(), reason }
}

fn digest(body: &str) -> String {
    sha256(body.as_bytes()).expect("memory can be read")
}
