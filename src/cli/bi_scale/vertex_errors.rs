//! Errors of local light by vertex, for ways to store transfer.

use std::io::Write as _;
use std::path::Path;

use serde_json::{Value, json};

use crate::cli::Problem;
use crate::cli::transfer::vertex_names::VertexNames;
use crate::io::write_file;
use crate::report::{Cell, Table};

/// Per way the squared error of the local light of each vertex: summed over red, green and blue and over the vertex's
/// local directions.
pub(super) struct VertexErrors {
    /// Rows of the transfer per vertex.
    local: usize,
    /// The squares of the exact light.
    squares: Vec<f64>,
    of_ways: Vec<(String, Vec<f64>)>,
}

impl VertexErrors {
    /// Of exact light in red, green and blue, with so many rows per vertex.
    pub(super) fn new(local: usize, exact: &[Vec<f64>; 3]) -> Self {
        let squares = by_vertex(local, exact[0].len(), |channel, row| exact[channel][row]);
        Self { local, squares, of_ways: Vec::new() }
    }

    /// Adds the light by a way.
    pub(super) fn push(&mut self, way: &str, found: &[Vec<f64>; 3], exact: &[Vec<f64>; 3]) {
        let difference = |channel: usize, row: usize| found[channel][row] - exact[channel][row];
        self.of_ways.push((way.to_owned(), by_vertex(self.local, exact[0].len(), difference)));
    }

    /// Per way the vertex of the largest squared error, of equals the first, and that error.
    fn most(&self) -> impl Iterator<Item = (&str, usize, f64)> {
        self.of_ways.iter().map(|(way, squared)| {
            let most = |a: &usize, b: &usize| squared[*a].total_cmp(&squared[*b]).then(b.cmp(a));
            let vertex = (0..squared.len()).max_by(most).unwrap_or(0);
            (way.as_str(), vertex, squared.get(vertex).copied().unwrap_or(0.0))
        })
    }

    /// [`Self::most`] as a table; `noun` is what the rows of the matrix belong to.
    pub(super) fn table(&self, noun: &str, names: Option<&VertexNames<'_>>) -> Table {
        let of_model = if names.is_some() { "model_vertex x y z" } else { "" };
        let mut table = Table::of("Where they are off most", &format!("way {noun} squared_error {of_model}"));
        for (way, vertex, squared) in self.most() {
            let row: [Cell; 3] = [way.into(), vertex.into(), Cell::measured(squared)];
            table.push(row.into_iter().chain(names.into_iter().flat_map(|names| names.cells(vertex))));
        }
        table
    }

    /// [`Self::most`] for machines.
    pub(super) fn largest(&self, noun: &str, names: Option<&VertexNames<'_>>) -> Vec<Value> {
        let of_way = |(_, vertex, squared): (&str, usize, f64)| {
            json!({ noun: vertex, "squared_error": squared,
                    "of_model": names.map(|names| names.document(vertex)) })
        };
        self.most().map(of_way).collect()
    }

    /// Writes a line per way and vertex, shortest digits that read back to the same numbers.
    pub(super) fn write(&self, path: &Path, noun: &str, names: Option<&VertexNames<'_>>) -> Result<(), Problem> {
        write_file(path, |file| {
            let mut file = std::io::BufWriter::new(file);
            let columns = names.map_or_else(String::new, |_| format!(",{}", VertexNames::COLUMNS));
            writeln!(file, "way,{noun},squared_error,squares{columns}")?;
            for (way, squared) in &self.of_ways {
                for (vertex, (squared, squares)) in squared.iter().zip(&self.squares).enumerate() {
                    let name = names.map_or_else(String::new, |names| format!(",{}", names.fields(vertex)));
                    writeln!(file, "\"{way}\",{vertex},{squared:e},{squares:e}{name}")?;
                }
            }
            file.flush()
        })
        .map_err(Problem::from)
    }
}

/// Sums of squares over channels and the rows of each vertex.
fn by_vertex(local: usize, rows: usize, value: impl Fn(usize, usize) -> f64) -> Vec<f64> {
    let of_vertex = |vertex: usize| {
        let rows = vertex * local..(vertex + 1) * local;
        let errors = rows.flat_map(|row| [0, 1, 2].map(|channel| value(channel, row)));
        errors.map(|error| error * error).sum()
    };
    (0..rows / local).map(of_vertex).collect()
}
