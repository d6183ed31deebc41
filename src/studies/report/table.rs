//! Tables, and the folding of rows whose results equal an earlier row's.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::{Map, Value, json};

use super::cell::{Cell, Folded};
use super::layout::{Column, within};
use super::not_encoded;
use super::visible::visible_line;
use crate::error::InputError;

/// Table of rows under headings.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    title: String,
    headings: Vec<String>,
    rows: Vec<Vec<Cell>>,
    names: BTreeMap<usize, String>,
}

impl Table {
    /// Creates an empty table. CSV and JSON name its columns by [`Table::keys`].
    pub fn new(title: impl Into<String>, headings: &[impl AsRef<str>]) -> Self {
        let headings = headings.iter().map(|heading| heading.as_ref().to_owned()).collect();
        Self { title: title.into(), headings, ..Self::default() }
    }

    /// Creates an empty table; `columns` has its headings, separated by blanks.
    pub fn of(title: impl Into<String>, columns: &str) -> Self {
        Self::new(title, &columns.split_whitespace().collect::<Vec<_>>())
    }

    /// Adds rows, each as [`Table::push`] does.
    #[must_use]
    pub fn with<R: IntoIterator<Item = Cell>>(mut self, rows: impl IntoIterator<Item = R>) -> Self {
        rows.into_iter().for_each(|row| self.push(row));
        self
    }

    /// Creates an empty table; after the columns, separated by blanks, every label adds `LABEL_r`, `_g` and `_b`.
    pub fn with_colors<'a>(title: &str, columns: &str, labels: impl IntoIterator<Item = &'a str>) -> Self {
        let colors = labels.into_iter().flat_map(|label| ["r", "g", "b"].map(|channel| format!("{label}_{channel}")));
        Self::new(title, &columns.split(' ').map(str::to_owned).chain(colors).collect::<Vec<_>>())
    }

    /// Adds a row; missing cells are empty, surplus ones are dropped.
    pub fn push(&mut self, row: impl IntoIterator<Item = Cell>) {
        let mut row: Vec<Cell> = row.into_iter().collect();
        row.resize(self.headings.len(), Cell::Empty);
        self.rows.push(row);
    }

    /// Adds a row with a name for links: unique among all tables of a page, and without blanks.
    pub fn push_named(&mut self, name: String, row: impl IntoIterator<Item = Cell>) {
        self.names.insert(self.rows.len(), name);
        self.push(row);
    }

    pub(super) fn name(&self, row: usize) -> Option<&str> {
        self.names.get(&row).map(String::as_str)
    }

    /// Title.
    pub fn title(&self) -> &str {
        &self.title
    }

    /// Headings of the columns.
    pub fn headings(&self) -> &[String] {
        &self.headings
    }

    /// Rows, each with as many cells as there are headings.
    pub fn rows(&self) -> &[Vec<Cell>] {
        &self.rows
    }

    /// Headings for people: words in place of field names.
    pub fn shown_headings(&self) -> Vec<String> {
        self.headings.iter().map(|heading| visible_line(&heading.replace('_', " ")).trim().to_owned()).collect()
    }

    /// Column names for programs: words of letters and digits joined by underscores, with `%` as `percent`.
    pub fn keys(&self) -> Vec<String> {
        let word = |word: &str| word.replace('%', "percent");
        let words = |heading: &String| {
            let spaced = heading.replace('%', " % ");
            let words = spaced.split(|c: char| !c.is_alphanumeric() && c != '%').filter(|word| !word.is_empty());
            words.map(word).collect::<Vec<_>>().join("_")
        };
        self.headings.iter().map(words).collect()
    }

    /// Formats the table for people, without the title, in lines of at most `width` columns (at least
    /// [`super::layout::MIN_WIDTH`]): words and numbers are not broken.
    pub fn text_within(&self, width: usize) -> String {
        let column = |(i, heading): (usize, String)| {
            let cell = |row: &Vec<Cell>| (visible_line(&row[i].text()).into_owned(), row[i].is_number());
            Column::new(heading, self.rows.iter().map(cell).collect())
        };
        let columns: Vec<_> = self.shown_headings().into_iter().enumerate().map(column).collect();
        within(&columns, self.key_columns(), width)
    }

    /// Number of leading key columns: the columns that distinguish the rows, if they hold words; otherwise one.
    fn key_columns(&self) -> usize {
        let words = |column: usize| self.rows.iter().all(|row| matches!(row[column], Cell::Text(_) | Cell::Empty));
        let rows: Vec<&Vec<Cell>> =
            self.rows.iter().filter(|row| !row.iter().any(|cell| matches!(cell, Cell::Folded(_)))).collect();
        let apart = |columns: &usize| {
            let names: BTreeSet<Vec<String>> =
                rows.iter().map(|row| row[..*columns].iter().map(Cell::text).collect()).collect();
            names.len() == rows.len()
        };
        let leading = (0..self.headings.len()).take_while(|column| *column == 0 || words(*column)).count();
        (1..=leading).find(apart).unwrap_or(1)
    }

    /// Folds rows whose results equal an earlier row's into one row. `first[i]` is the first row with the result of row
    /// i. `called` names a row; `rows` and `same` are as in [`Folded`]. A table is unchanged if its number of rows
    /// differs from the length of `first`; otherwise its rows lose their names in links.
    #[must_use]
    pub fn folded(
        &self,
        first: &[usize],
        called: impl Fn(usize) -> String,
        (rows, same): ([&'static str; 2], &'static str),
    ) -> Self {
        if first.len() != self.rows.len() {
            return self.clone();
        }
        let mut table = Self { rows: Vec::new(), names: BTreeMap::new(), ..self.clone() };
        for (row, others) in groups(first) {
            table.push(self.rows[row].iter().cloned());
            if !others.is_empty() {
                let names = others.into_iter().map(&called).collect();
                let folded = Folded { rows, same, first: called(row), names };
                table.push([Cell::Folded(folded)]);
            }
        }
        table
    }

    /// Sentence for each folded row that lists the rows it replaces.
    pub fn notes(&self) -> Vec<String> {
        let folded = |cell: &Cell| if let Cell::Folded(folded) = cell { Some(folded.note()) } else { None };
        self.rows.iter().flatten().filter_map(folded).collect()
    }

    /// Names of the columns whose numbers have a mark in this row.
    fn marked<'a>(keys: &'a [String], row: &'a [Cell]) -> impl Iterator<Item = &'a str> {
        keys.iter().zip(row).filter(|(_, cell)| cell.mark().is_some()).map(|(key, _)| key.as_str())
    }

    /// Encodes the table as CSV with a header line of [`Table::keys`]; if any number has a mark, a last column `marked`
    /// names the columns of such numbers, with semicolons between them. Fails if the encoder fails.
    pub fn csv(&self) -> Result<String, InputError> {
        let fail = |error: csv::Error| not_encoded("CSV", error);
        let mut writer = csv::Writer::from_writer(Vec::new());
        let keys = self.keys();
        let marks: Vec<String> =
            self.rows.iter().map(|row| Self::marked(&keys, row).collect::<Vec<_>>().join(";")).collect();
        let with_marks = marks.iter().any(|mark| !mark.is_empty());
        let last = |mark: &str| with_marks.then(|| mark.to_owned());
        writer.write_record(keys.iter().cloned().chain(last("marked"))).map_err(fail)?;
        for (row, mark) in self.rows.iter().zip(&marks) {
            writer.write_record(row.iter().map(Cell::machine_text).chain(last(mark))).map_err(fail)?;
        }
        let bytes = writer.into_inner().map_err(|error| not_encoded("CSV", error))?;
        String::from_utf8(bytes).map_err(|error| not_encoded("CSV", error))
    }

    /// Converts the rows to JSON objects with [`Table::keys`]; `marked` lists columns whose numbers have a mark.
    pub fn json(&self) -> Value {
        let keys = self.keys();
        let row = |row: &Vec<Cell>| {
            let fields = keys.iter().zip(row);
            let mut object: Map<_, _> = fields.map(|(key, cell)| (key.clone(), cell.json())).collect();
            let marked: Vec<_> = Self::marked(&keys, row).collect();
            if !marked.is_empty() {
                object.insert("marked".to_owned(), json!(marked));
            }
            Value::Object(object)
        };
        Value::Array(self.rows.iter().map(row).collect())
    }
}

const FEWEST: usize = 2;

/// Returns the rows to show, in order, each with the rows folded into it: at least [`FEWEST`] later rows with equal
/// results. `first[i]` is the first row with the result of row i.
fn groups(first: &[usize]) -> Vec<(usize, Vec<usize>)> {
    let same = |row: usize| -> Vec<usize> { (row + 1..first.len()).filter(|other| first[*other] == row).collect() };
    let folds = |row: &usize| same(first[*row]).len() >= FEWEST;
    (0..first.len())
        .filter(|row| first[*row] == *row || !folds(row))
        .map(|row| (row, if first[row] == row && folds(&row) { same(row) } else { Vec::new() }))
        .collect()
}
