//! Tables.

use comfy_table::{CellAlignment, ContentArrangement, presets};
use serde::Serialize;
use serde_json::{Map, Value};

use super::ReportError;
use super::visible::visible_line;

/// One entry of a table.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Cell {
    /// Words.
    Text(String),
    /// A number of things.
    Count(u64),
    /// A whole number with a sign.
    Int(i64),
    /// A measured or computed number; written with enough digits to read back to the same bits.
    Real(f64),
    /// Yes or no.
    Flag(bool),
    /// Nothing to say.
    Empty,
}

impl Cell {
    /// The entry as a reader sees it; empty for [`Cell::Empty`].
    pub fn text(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            Self::Count(count) => count.to_string(),
            Self::Int(int) => int.to_string(),
            Self::Real(real) => real_text(*real),
            Self::Flag(true) => "yes".to_owned(),
            Self::Flag(false) => "no".to_owned(),
            Self::Empty => String::new(),
        }
    }

    /// Whether the entry is set flush right.
    pub const fn is_number(&self) -> bool {
        matches!(self, Self::Count(_) | Self::Int(_) | Self::Real(_))
    }
}

/// The shortest text that reads back to the same number: plain near one, with an exponent far from it.
fn real_text(real: f64) -> String {
    let magnitude = real.abs();
    if real == 0.0 || !real.is_finite() || (1e-4..1e9).contains(&magnitude) {
        format!("{real}")
    } else {
        format!("{real:e}")
    }
}

macro_rules! cell_from {
    ($($from:ty => $variant:ident),* $(,)?) => {
        $(impl From<$from> for Cell {
            fn from(value: $from) -> Self {
                Self::$variant(value.into())
            }
        })*
    };
}
cell_from!(&str => Text, String => Text, u8 => Count, u16 => Count, u32 => Count, u64 => Count, i32 => Int, i64 => Int,
    f32 => Real, f64 => Real, bool => Flag);

impl From<usize> for Cell {
    fn from(value: usize) -> Self {
        Self::Count(value as u64)
    }
}

impl<T: Into<Self>> From<Option<T>> for Cell {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Empty, Into::into)
    }
}

/// Rows under headings.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    title: String,
    headings: Vec<String>,
    rows: Vec<Vec<Cell>>,
}

impl Table {
    /// An empty table. The headings double as the names of the fields in CSV and JSON.
    pub fn new(title: impl Into<String>, headings: &[impl AsRef<str>]) -> Self {
        let headings = headings.iter().map(|heading| heading.as_ref().to_owned()).collect();
        Self { title: title.into(), headings, rows: Vec::new() }
    }

    /// An empty table whose columns are named by the words of a text.
    pub fn of(title: impl Into<String>, columns: &str) -> Self {
        Self::new(title, &columns.split_whitespace().collect::<Vec<_>>())
    }

    /// Adds a row; what it lacks is left empty, what it has too much is dropped.
    pub fn push(&mut self, row: impl IntoIterator<Item = Cell>) {
        let mut row: Vec<Cell> = row.into_iter().collect();
        row.resize(self.headings.len(), Cell::Empty);
        self.rows.push(row);
    }

    /// What the table shows.
    pub fn title(&self) -> &str {
        &self.title
    }

    /// The headings of the columns.
    pub fn headings(&self) -> &[String] {
        &self.headings
    }

    /// The rows, each as long as there are headings.
    pub fn rows(&self) -> &[Vec<Cell>] {
        &self.rows
    }

    /// The table for a log or another program, without the title: one line per row, columns as wide as they need to be.
    pub fn text(&self) -> String {
        self.laid_out(comfy_table::Table::new().set_content_arrangement(ContentArrangement::Disabled))
    }

    /// The table for a terminal of so many columns, without the title: long entries go over several lines.
    pub fn text_within(&self, columns: u16) -> String {
        let mut table = comfy_table::Table::new();
        self.laid_out(table.set_content_arrangement(ContentArrangement::Dynamic).set_width(columns))
    }

    fn laid_out(&self, table: &mut comfy_table::Table) -> String {
        table.load_style(presets::ASCII_MARKDOWN).set_header(&self.headings);
        for row in &self.rows {
            table.add_row(row.iter().map(|cell| {
                let alignment = if cell.is_number() { CellAlignment::Right } else { CellAlignment::Left };
                comfy_table::Cell::new(visible_line(&cell.text())).set_alignment(alignment)
            }));
        }
        table.trim_fmt()
    }

    /// The table as CSV with a line of headings.
    ///
    /// # Errors
    /// If the encoder refuses.
    pub fn csv(&self) -> Result<String, ReportError> {
        let fail = |error: csv::Error| ReportError::encode("CSV")(&error);
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(&self.headings).map_err(fail)?;
        for row in &self.rows {
            writer.write_record(row.iter().map(Cell::text)).map_err(fail)?;
        }
        let bytes = writer.into_inner().map_err(|error| ReportError::encode("CSV")(&error))?;
        String::from_utf8(bytes).map_err(|error| ReportError::encode("CSV")(&error))
    }

    /// The rows as a JSON array of objects. JSON has no infinity and no NaN: they are written as text.
    pub fn json(&self) -> Value {
        let row = |row: &Vec<Cell>| {
            let fields = self.headings.iter().zip(row);
            Value::Object(fields.map(|(name, cell)| (name.clone(), json_cell(cell))).collect::<Map<_, _>>())
        };
        Value::Array(self.rows.iter().map(row).collect())
    }
}

fn json_cell(cell: &Cell) -> Value {
    match cell {
        Cell::Real(real) if !real.is_finite() => Value::String(cell.text()),
        _ => serde_json::to_value(cell).unwrap_or(Value::Null),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> Table {
        let mut table = Table::new("Formats", &["format", "leaks", "error"]);
        table.push(["s3.12".into(), 12_usize.into(), 0.125.into()]);
        table.push(["fp,32".into(), 0_usize.into(), f64::INFINITY.into()]);
        table
    }

    #[test]
    fn csv_quotes_what_needs_it() {
        assert_eq!(sample().csv().expect("a table of text"), "format,leaks,error\ns3.12,12,0.125\n\"fp,32\",0,inf\n");
    }

    #[test]
    fn json_keeps_numbers_and_survives_infinity() {
        assert_eq!(
            sample().json().to_string(),
            r#"[{"error":0.125,"format":"s3.12","leaks":12},{"error":"inf","format":"fp,32","leaks":0}]"#
        );
    }

    #[test]
    fn short_rows_are_filled() {
        let mut table = Table::new("t", &["a", "b"]);
        table.push(["x".into()]);
        assert_eq!(table.rows()[0], [Cell::Text("x".to_owned()), Cell::Empty]);
    }

    #[test]
    fn far_numbers_get_an_exponent() {
        assert_eq!(Cell::Real(1.5e-7).text(), "1.5e-7");
        assert_eq!(Cell::Real(0.0).text(), "0");
        assert_eq!(Cell::Real(1024.5).text(), "1024.5");
    }
}
