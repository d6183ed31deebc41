//! What a study found: text, tables, charts, pictures, files and a verdict.

use std::ops::Range;

use serde_json::{Map, Value, json};

use super::palette::Color;
use super::{Chart, Provenance, Table};
use crate::picture::{Picture, RgbImage};

/// A file of an output folder: its name and its contents.
pub type NamedFile = (String, Vec<u8>);

/// How a study, or a command that checks something, ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Verdict {
    /// Done; where something was checked, it held.
    #[default]
    Done,
    /// Something was checked and did not hold.
    Failed,
}

impl Verdict {
    /// [`Verdict::Done`] if the check held.
    pub const fn held(held: bool) -> Self {
        if held { Self::Done } else { Self::Failed }
    }
}

/// A piece of a page; tables, charts and pictures by their places in the findings.
#[derive(Clone, Debug)]
pub(super) enum Passage {
    Heading(String),
    Paragraph(String),
    Table(usize),
    Chart(usize),
    /// Side by side.
    Pictures(Range<usize>),
    Legend(Legend),
}

/// Colours of a false-colour picture, with what each stands for.
pub type Legend = Vec<(Color, String)>;

/// Whether a count of a tally is what one hopes for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tone {
    /// It is.
    Good,
    /// It says nothing either way.
    Neutral,
    /// It is not.
    Bad,
}

/// So many of the things that a study counts came out alike.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TallyEntry {
    /// How many.
    pub count: u64,
    /// What they are, in the number of the count: `row missed`, `rows missed`.
    pub what: String,
    /// Whether that is good.
    pub tone: Tone,
}

/// A table with the places where it is written besides the page.
#[derive(Clone, Debug)]
pub struct FoundTable {
    pub(super) table: Table,
    /// The table for programs, where it has more rows.
    whole: Option<Table>,
    pub(super) csv: Option<&'static str>,
    field: Option<&'static str>,
    printed: bool,
}

impl From<Table> for FoundTable {
    /// A table that is printed by the command, and written nowhere.
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

    /// Lets one row stand for those that found the same as a row above ([`Table::folded`]) on the page and in print;
    /// CSV and document keep all.
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

    /// The table with all its rows.
    pub(super) fn whole(&self) -> &Table {
        self.whole.as_ref().unwrap_or(&self.table)
    }

    /// Does not print the table.
    #[must_use]
    pub fn unprinted(self) -> Self {
        Self { printed: false, ..self }
    }
}

/// A chart, the name of its file, and what stands under it.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedChart {
    /// File name without folder and ending.
    pub name: String,
    /// The chart.
    pub chart: Chart,
    /// What stands under it.
    pub caption: String,
}

/// A picture, the name of its file, and what stands under it.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedPicture {
    /// File name without folder and ending.
    pub name: String,
    /// The picture as a screen shows it.
    pub image: RgbImage,
    /// What stands under it; read aloud to those who cannot see it.
    pub caption: String,
    /// How much each pixel matters where the picture is shown smaller; 0 and what is missing: not more than others.
    pub(super) ranks: Vec<u8>,
}

impl NamedPicture {
    /// A picture with its name and caption.
    pub fn new(name: impl Into<String>, image: RgbImage, caption: impl Into<String>) -> Self {
        Self { name: name.into(), image, caption: caption.into(), ranks: Vec::new() }
    }

    /// Marks pixels that must not get lost where the picture is shown smaller: a rank per pixel, 0 for those that may.
    #[must_use]
    pub fn marked(self, ranks: Vec<u8>) -> Self {
        Self { ranks, ..self }
    }
}

/// What a study found. [`Findings::heading`] and the like append to the page, from top to bottom; `keep_*` adds what is
/// only written to a file. Every picture and chart is encoded once, for its file and the page.
///
/// The page begins with conclusion and tally. What is appended before the first heading follows them, and then the
/// table of contents: a study shows its most telling picture or chart there.
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
    printed: Vec<String>,
    verdict: Verdict,
}

impl Findings {
    /// Nothing yet, under the title of the page.
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), ..Self::default() }
    }

    /// Appends a sentence to the conclusion, which the page begins with. It is computed from the rows, never written by
    /// hand.
    pub fn conclusion(&mut self, sentence: impl Into<String>) {
        self.conclusion.push(sentence.into());
    }

    /// Appends a count to the tally under the conclusion, with what is counted in the singular and the plural.
    pub fn tally(&mut self, count: u64, [one, many]: [&str; 2], tone: Tone) {
        let what = if count == 1 { one } else { many };
        self.tally.push(TallyEntry { count, what: what.to_owned(), tone });
    }

    /// Appends a heading to the page.
    pub fn heading(&mut self, text: impl Into<String>) {
        self.text.push(Passage::Heading(text.into()));
    }

    /// Appends a paragraph of plain text to the page.
    pub fn paragraph(&mut self, text: impl Into<String>) {
        self.text.push(Passage::Paragraph(text.into()));
    }

    /// Appends a table to the page, if it has rows, and which rows were folded in it.
    pub fn table(&mut self, table: impl Into<FoundTable>) {
        let table = table.into();
        if !table.table.rows().is_empty() {
            self.text.push(Passage::Table(self.tables.len()));
            table.table.notes().into_iter().for_each(|note| self.paragraph(note));
        }
        self.tables.push(table);
    }

    /// Appends a table and a paragraph on it to the page, if the table has rows.
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
        self.text.push(Passage::Pictures(first..self.pictures.len()));
    }

    /// Appends the legend of a false-colour picture to the page.
    pub fn legend(&mut self, legend: Legend) {
        self.text.push(Passage::Legend(legend));
    }

    /// A table that does not stand on the page.
    pub fn keep_table(&mut self, table: impl Into<FoundTable>) {
        self.tables.push(table.into().unprinted());
    }

    /// A picture that does not stand on the page.
    pub fn keep_picture(&mut self, name: impl Into<String>, image: RgbImage) {
        self.pictures.push(NamedPicture::new(name, image, ""));
    }

    /// A picture as numbers, written to `NAME.exr`.
    pub fn keep_layers(&mut self, name: impl Into<String>, picture: Picture) {
        self.layers.push((name.into(), picture));
    }

    /// The camera of all pictures, for the files of numbers: see [`crate::picture::PictureNotes`].
    pub const fn taken_from(&mut self, world_to_camera: [f32; 16]) {
        self.world_to_camera = Some(world_to_camera);
    }

    /// A file of its own.
    pub fn keep_file(&mut self, name: impl Into<String>, bytes: Vec<u8>) {
        self.files.push((name.into(), bytes));
    }

    /// A field of the document that is no table.
    pub fn field(&mut self, name: &str, value: Value) {
        self.fields.insert(name.to_owned(), value);
    }

    /// A line that the command prints after the tables.
    pub fn print(&mut self, line: String) {
        self.printed.push(line);
    }

    /// What the exit code says.
    pub const fn conclude(&mut self, verdict: Verdict) {
        self.verdict = verdict;
    }

    /// What the exit code says.
    pub const fn verdict(&self) -> Verdict {
        self.verdict
    }

    /// The sentences of the conclusion.
    pub fn conclusions(&self) -> &[String] {
        &self.conclusion
    }

    /// The counts of the tally.
    pub fn tallied(&self) -> &[TallyEntry] {
        &self.tally
    }

    /// The tables that the command prints, those without rows left out.
    pub fn printed_tables(&self) -> impl Iterator<Item = &Table> {
        self.tables.iter().filter(|found| found.printed && !found.table.rows().is_empty()).map(|found| &found.table)
    }

    /// The lines that the command prints after them.
    pub fn printed_lines(&self) -> &[String] {
        &self.printed
    }

    /// Everything for machines: provenance, conclusion, tables, fields.
    pub fn document(&self, provenance: &Provenance) -> Value {
        let mut document = self.fields.clone();
        document.insert("provenance".to_owned(), json!(provenance));
        document.insert("conclusion".to_owned(), json!(self.conclusion));
        for found in &self.tables {
            if let Some(name) = found.field {
                document.insert(name.to_owned(), found.whole().json());
            }
        }
        Value::Object(document)
    }
}
