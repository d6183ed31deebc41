//! Radiance of vertices, as a table or an array.

use crate::io::{NumberTable, write_npy};
use crate::report::{Cell, Findings, FoundTable, Table};

/// Format of a file with the radiance of vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::EnumIter, strum::EnumMessage)]
#[strum(serialize_all = "lowercase")]
pub enum ValuesFormat {
    /// vertices.csv: vertex, its number in the model's file, position, red, green, blue.
    Csv,
    /// vertices.npy: a row per vertex of position, red, green, blue, in f32.
    Npy,
}

/// That radiance of vertices is written, and the vertices' numbers in the model's file.
#[derive(Clone, Debug, PartialEq)]
pub struct VertexValues {
    /// The format.
    pub format: ValuesFormat,
    /// One per vertex; `None` where the file gives none.
    pub numbers: Vec<Option<u32>>,
}

impl VertexValues {
    /// Keeps the radiance of each vertex towards the camera, whether or not the camera sees it.
    pub(super) fn keep(&self, positions: &[[f32; 3]], radiance: &[[f64; 3]], found: &mut Findings) {
        match self.format {
            ValuesFormat::Csv => {
                let headings = ["vertex", "model_vertex", "x", "y", "z", "red", "green", "blue"];
                let mut table = Table::new("Radiance of vertices", &headings);
                for (vertex, ((&number, place), color)) in self.numbers.iter().zip(positions).zip(radiance).enumerate()
                {
                    let numbers: [Cell; 2] = [vertex.into(), number.map_or(Cell::Empty, Cell::from)];
                    table.push(numbers.into_iter().chain(place.map(Cell::from)).chain(color.map(Cell::from)));
                }
                found.keep_table(FoundTable::from(table).csv("vertices"));
            }
            ValuesFormat::Npy => {
                let row = |(place, color): (&[f32; 3], &[f64; 3])| {
                    let [x, y, z] = *place;
                    let [red, green, blue] = color.map(|channel| channel as f32);
                    [x, y, z, red, green, blue]
                };
                let values = positions.iter().zip(radiance).flat_map(row).collect();
                let mut bytes = Vec::new();
                // Writing to memory does not fail.
                if write_npy(&NumberTable { columns: 6, values }, &mut bytes).is_ok() {
                    found.keep_file("vertices.npy", bytes);
                }
            }
        }
    }
}
