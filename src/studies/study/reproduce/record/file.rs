//! Files of recorded runs.

use serde::{Deserialize, Serialize};

use super::cells::{coded, decoded};
use super::made::{RecordMade, RecordStatus};
use crate::report::Table;
use crate::study::reproduce::{
    Contradiction, Dependence, EntryFindings, Method, PaperRow, RowSource, StudyError, equations, paper_row,
};

const HEAD: &str = "# A run at full size, written by `crossbar reproduce --record`.\n";

/// Recorded run of an entry at full size: its findings, except charts and rows that are expressions of printed values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EntryRecord {
    /// Name of the entry.
    pub entry: String,
    text: Vec<String>,
    questions: Vec<String>,
    /// Provenance of the record.
    pub made: RecordMade,
    #[serde(default)]
    row: Vec<RecordedRow>,
    #[serde(default)]
    table: Vec<RecordedTable>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct RecordedRow {
    figure: String,
    device: String,
    method: Method,
    /// Printed values that predicted our value; a value that is neither predicted nor calibrated was counted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    predicted_from: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    calibrated_on: Option<String>,
    ours: f64,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    readings: Vec<f64>,
    /// Range of values that the computation can give, and the reason.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    range: Option<[f64; 2]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    why: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    contradiction: Option<Contradiction>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct RecordedTable {
    title: String,
    headings: Vec<String>,
    /// Cells as text.
    rows: Vec<Vec<String>>,
}

impl EntryRecord {
    /// Creates the record of a run at full size.
    pub fn new(entry: &str, found: &EntryFindings, made: RecordMade) -> Self {
        Self {
            entry: entry.to_owned(),
            text: found.text.clone(),
            questions: found.questions.iter().map(|question| (*question).to_owned()).collect(),
            made,
            row: found.rows.iter().filter(|row| row.target.equation.is_none()).map(RecordedRow::new).collect(),
            table: found.tables.iter().map(RecordedTable::new).collect(),
        }
    }

    /// Values in the row for a figure: ours, then the other readings. `None` if the figure has no row.
    pub(super) fn values(&self, figure: &str) -> Option<impl Iterator<Item = f64> + Clone> {
        let row = self.row.iter().find(|row| row.figure == figure)?;
        Some(std::iter::once(row.ours).chain(row.readings.iter().copied()))
    }

    /// Formats the file. Fails if the record cannot be written as TOML.
    pub fn text(&self) -> Result<String, StudyError> {
        let body = toml::to_string(self).map_err(|error| StudyError::coded("reproduce::record", error))?;
        Ok(format!("{HEAD}{body}"))
    }

    /// Parses the file of an entry; errors are sentences. Fails if it is malformed, or is the record of another entry.
    pub fn parse(entry: &str, text: &str) -> Result<Self, String> {
        let malformed = |reason: String| format!("the record of `{entry}`: {reason}");
        let record: Self = toml::from_str(text).map_err(|error| malformed(error.to_string()))?;
        if record.entry != entry {
            return Err(format!("expected the record of `{entry}`, found the record of `{}`", record.entry));
        }
        let mut cells = record.table.iter().flat_map(|table| table.rows.iter().flatten());
        match cells.find(|cell| decoded(cell).is_none()) {
            Some(cell) => Err(malformed(format!("expected a cell of a table, found `{cell}`"))),
            None => Ok(record),
        }
    }

    /// Findings of the run. Rows that are expressions of printed values are computed by this program, and come first.
    /// Fails if a figure of the record is unknown or not judged.
    pub fn findings(&'static self) -> Result<EntryFindings, StudyError> {
        let mut rows = equations(&self.entry)?;
        for row in &self.row {
            rows.push(row.row()?);
        }
        Ok(EntryFindings {
            text: self.text.clone(),
            rows,
            questions: self.questions.iter().map(String::as_str).collect(),
            tables: self.table.iter().map(RecordedTable::table).collect(),
            record: Some(RecordStatus::Recorded(&self.made)),
            ..EntryFindings::default()
        })
    }
}

impl RecordedRow {
    fn new(row: &PaperRow) -> Self {
        let (predicted_from, calibrated_on) = match row.dependence {
            Dependence::Predicted { from } => (Some(from.to_owned()), None),
            Dependence::Calibrated { on } => (None, Some(on.to_owned())),
            Dependence::Counted => (None, None),
        };
        let (range, why) = row.confinement().unzip();
        Self {
            figure: row.target.id.clone(),
            device: row.device.to_owned(),
            method: row.method,
            predicted_from,
            calibrated_on,
            ours: row.ours,
            readings: row.readings.clone(),
            range,
            why: why.map(str::to_owned),
            contradiction: row.contradiction().cloned(),
        }
    }

    fn row(&'static self) -> Result<PaperRow, StudyError> {
        let dependence = Dependence::new(self.calibrated_on.as_deref(), self.predicted_from.as_deref());
        let row = paper_row(&self.figure, (&self.device, self.method), (self.ours, dependence))?;
        let mut row = row.with_readings(self.readings.iter().copied()).contradicted(self.contradiction.clone());
        row.source = RowSource::Recorded;
        Ok(match (self.range, &self.why) {
            (Some(range), Some(why)) => row.confined(range, why),
            _ => row,
        })
    }
}

impl RecordedTable {
    fn new(table: &Table) -> Self {
        let rows = table.rows().iter().map(|row| row.iter().map(coded).collect());
        Self { title: table.title().to_owned(), headings: table.headings().to_vec(), rows: rows.collect() }
    }

    fn table(&self) -> Table {
        let mut table = Table::new(self.title.as_str(), &self.headings);
        for row in &self.rows {
            table.push(row.iter().filter_map(|cell| decoded(cell)));
        }
        table
    }
}
