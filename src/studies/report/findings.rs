//! Findings of a study: text, tables, charts, pictures, files and a verdict.

use std::ops::Range;

use serde_json::{Map, Value, json};

use super::palette::Color;
use super::summary::{SummaryLine, TallyEntry, Tone};
use super::{Chart, Provenance, Scale, Series, Table};
use crate::picture::{Picture, RgbImage};

/// File of an output folder: its name and its contents.
pub type NamedFile = (String, Vec<u8>);

/// Outcome of a study, or of a command that checks something.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Verdict {
    /// Done; every check passed.
    #[default]
    Done,
    /// A check failed.
    Failed,
}

impl Verdict {
    /// [`Verdict::Done`] if the check passed, otherwise [`Verdict::Failed`].
    pub const fn held(held: bool) -> Self {
        if held { Self::Done } else { Self::Failed }
    }
}

/// Part of a page; tables, charts and pictures are given by their indices in the findings.
#[derive(Clone, Debug)]
pub(super) enum Passage {
    /// Text, and the counts of its section.
    Heading(String, Vec<TallyEntry>),
    SummaryLines(Vec<SummaryLine>),
    Paragraph(String),
    Table(usize),
    Chart(usize),
    /// Pictures side by side.
    Pictures(Range<usize>),
    Legend(Legend),
}

/// Colors of a false-color picture with their meanings.
pub type Legend = Vec<(Color, String)>;

/// Table with its destinations besides the page.
#[derive(Clone, Debug)]
pub struct FoundTable {
    pub(super) table: Table,
    /// Table before rows were folded, if any were.
    whole: Option<Table>,
    pub(super) csv: Option<&'static str>,
    field: Option<&'static str>,
    printed: bool,
}

impl From<Table> for FoundTable {
    /// Creates a table that the command prints, and that is not written to a file.
    fn from(table: Table) -> Self {
        Self { table, whole: None, csv: None, field: None, printed: true }
    }
}

impl FoundTable {
    /// Writes the table to `NAME.csv`, if it has rows.
    #[must_use]
    pub fn csv(self, name: &'static str) -> Self {
        Self { csv: Some(name), ..self }
    }

    /// Puts the table into this field of the document, with or without rows.
    #[must_use]
    pub fn field(self, name: &'static str) -> Self {
        Self { field: Some(name), ..self }
    }

    /// Folds rows as [`Table::folded`] does on the page and in print; CSV and document keep all rows.
    #[must_use]
    pub fn folded(
        self,
        first: &[usize],
        called: impl Fn(usize) -> String,
        what: ([&'static str; 2], &'static str),
    ) -> Self {
        let table = self.table.folded(first, called, what);
        Self { whole: Some(self.table), table, ..self }
    }

    /// Returns the table with all its rows.
    pub(super) fn whole(&self) -> &Table {
        self.whole.as_ref().unwrap_or(&self.table)
    }

    /// Excludes the table from printing.
    #[must_use]
    pub fn unprinted(self) -> Self {
        Self { printed: false, ..self }
    }
}

/// Picture with its file name and caption.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedPicture {
    /// File name without folder and extension.
    pub name: String,
    /// Picture in display encoding.
    pub image: RgbImage,
    /// Caption; it is also the alternative text.
    pub caption: String,
}

impl NamedPicture {
    /// Creates a picture with its name and caption.
    pub fn new(name: impl Into<String>, image: RgbImage, caption: impl Into<String>) -> Self {
        Self { name: name.into(), image, caption: caption.into() }
    }
}

/// Chart with its file name and caption.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedChart {
    /// File name without folder and extension.
    pub name: String,
    /// The chart.
    pub chart: Chart,
    /// Caption.
    pub caption: String,
}

impl NamedChart {
    /// Creates a chart of lines over a logarithmic vertical axis, with its title and the labels of both axes.
    pub fn logarithmic(name: &str, labels: [&str; 3], (x_scale, lines): (Scale, Vec<Series>), caption: &str) -> Self {
        let [title, x, y] = labels.map(str::to_owned);
        let chart = Chart { title, x, y, x_scale, y_scale: Scale::Logarithmic, lines, ..Chart::default() };
        Self { name: name.to_owned(), chart, caption: caption.to_owned() }
    }
}

/// Findings of a study. [`Findings::heading`] and similar methods append to the page, from top to bottom; `keep_*`
/// methods add what is only written to a file. Every picture and chart is encoded once, for both its file and the page.
///
/// The page begins with the conclusion and the tally, followed by everything appended before the first heading, and
/// then the table of contents: a study shows its most important picture or chart there.
#[derive(Clone, Debug, Default)]
pub struct Findings {
    pub(super) title: String,
    pub(super) text: Vec<Passage>,
    pub(super) tables: Vec<FoundTable>,
    pub(super) charts: Vec<NamedChart>,
    pub(super) pictures: Vec<NamedPicture>,
    pub(super) layers: Vec<(String, Picture)>,
    pub(super) files: Vec<NamedFile>,
    pub(super) world_to_camera: Option<[f32; 16]>,
    pub(super) conclusion: Vec<String>,
    pub(super) tally: Vec<TallyEntry>,
    fields: Map<String, Value>,
    introduction: Vec<String>,
    printed: Vec<String>,
    verdict: Verdict,
}

impl Findings {
    /// Creates empty findings with the title of the page.
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), ..Self::default() }
    }

    /// Appends a sentence to the conclusion at the top of the page. Compute it from the rows; never write it by hand.
    pub fn conclusion(&mut self, sentence: impl Into<String>) {
        self.conclusion.push(sentence.into());
    }

    /// Appends a count to the tally below the conclusion, with its noun in the singular and the plural.
    pub fn tally(&mut self, count: u64, [one, many]: [&str; 2], tone: Tone) {
        let what = if count == 1 { one } else { many };
        self.tally.push(TallyEntry { count, what: what.to_owned(), tone });
    }

    /// Appends a heading to the page.
    pub fn heading(&mut self, text: impl Into<String>) {
        self.counted_heading(text, Vec::new());
    }

    /// Appends a heading with the counts of its section; the table of contents shows them too.
    pub fn counted_heading(&mut self, text: impl Into<String>, tally: Vec<TallyEntry>) {
        self.text.push(Passage::Heading(text.into(), tally));
    }

    /// Appends lines to the page, each about a part of the study.
    pub fn summary_lines(&mut self, lines: Vec<SummaryLine>) {
        self.text.push(Passage::SummaryLines(lines));
    }

    /// Appends a paragraph of plain text to the page.
    pub fn paragraph(&mut self, text: impl Into<String>) {
        self.text.push(Passage::Paragraph(text.into()));
    }

    /// Appends a table to the page, if it has rows, and a note about its folded rows.
    pub fn table(&mut self, table: impl Into<FoundTable>) {
        let table = table.into();
        if !table.table.rows().is_empty() {
            self.text.push(Passage::Table(self.tables.len()));
            table.table.notes().into_iter().for_each(|note| self.paragraph(note));
        }
        self.tables.push(table);
    }

    /// Appends a table and an explanatory paragraph to the page, if the table has rows.
    pub fn explained_table(&mut self, table: FoundTable, text: &str) {
        let rows = !table.table.rows().is_empty();
        self.table(table);
        if rows {
            self.paragraph(text);
        }
    }

    /// Appends a chart to the page; it is also written to `NAME.svg`.
    pub fn chart(&mut self, chart: NamedChart) {
        self.text.push(Passage::Chart(self.charts.len()));
        self.charts.push(chart);
    }

    /// Appends pictures side by side to the page; they are also written to `NAME.png`.
    pub fn pictures(&mut self, pictures: Vec<NamedPicture>) {
        let first = self.pictures.len();
        self.pictures.extend(pictures);
        if first < self.pictures.len() {
            self.text.push(Passage::Pictures(first..self.pictures.len()));
        }
    }

    /// Appends the legend of a false-color picture to the page.
    pub fn legend(&mut self, legend: Legend) {
        self.text.push(Passage::Legend(legend));
    }

    /// Adds a table that is not on the page.
    pub fn keep_table(&mut self, table: impl Into<FoundTable>) {
        self.tables.push(table.into().unprinted());
    }

    /// Adds a picture of numeric channels, written to `NAME.exr`.
    pub fn keep_layers(&mut self, name: impl Into<String>, picture: Picture) {
        self.layers.push((name.into(), picture));
    }

    /// Sets the camera that the EXR files of all pictures record: see [`crate::picture::PictureNotes`].
    pub const fn taken_from(&mut self, world_to_camera: [f32; 16]) {
        self.world_to_camera = Some(world_to_camera);
    }

    /// Adds an output file.
    pub fn keep_file(&mut self, name: impl Into<String>, bytes: Vec<u8>) {
        self.files.push((name.into(), bytes));
    }

    /// Adds a field to the document.
    pub fn field(&mut self, name: &str, value: Value) {
        self.fields.insert(name.to_owned(), value);
    }

    /// Adds all fields of an object to the document.
    pub fn fields(&mut self, object: Value) {
        if let Value::Object(fields) = object {
            self.fields.extend(fields);
        }
    }

    /// Adds a line that the command prints before the tables.
    pub fn introduce(&mut self, line: String) {
        self.introduction.push(line);
    }

    /// Adds a line that the command prints after the tables.
    pub fn print(&mut self, line: String) {
        self.printed.push(line);
    }

    /// Sets the verdict, which determines the exit code.
    pub const fn conclude(&mut self, verdict: Verdict) {
        self.verdict = verdict;
    }

    /// Verdict, which determines the exit code.
    pub const fn verdict(&self) -> Verdict {
        self.verdict
    }

    /// Sentences of the conclusion.
    pub fn conclusions(&self) -> &[String] {
        &self.conclusion
    }

    /// Tables that the command prints, except those without rows.
    pub fn printed_tables(&self) -> impl Iterator<Item = &Table> {
        self.tables.iter().filter(|found| found.printed && !found.table.rows().is_empty()).map(|found| &found.table)
    }

    /// Lines that the command prints before the tables.
    pub fn introduction(&self) -> &[String] {
        &self.introduction
    }

    /// Lines that the command prints after the tables.
    pub fn printed_lines(&self) -> &[String] {
        &self.printed
    }

    /// Builds the document for programs: provenance, conclusion, tables, fields.
    pub fn document(&self, provenance: &Provenance) -> Value {
        let mut document = self.plain_document();
        document["provenance"] = json!(provenance);
        document["conclusion"] = json!(self.conclusion);
        document
    }

    /// Builds the document of a command without provenance: fields, and the tables that have a field.
    pub fn plain_document(&self) -> Value {
        let tables = self.tables.iter().filter_map(|found| Some((found.field?.to_owned(), found.whole().json())));
        Value::Object(self.fields.clone().into_iter().chain(tables).collect())
    }
}
