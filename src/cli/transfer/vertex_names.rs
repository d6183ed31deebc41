//! Vertices as their user knows them: by the number in the model's file, and by place.

use std::path::Path;

use serde_json::{Value, json};

use crate::cli::model_file::vertex_numbers;
use crate::report::Cell;
use crate::transfer::Vertices;

/// Names of the vertices of transfer. Rows of tables end in [`Self::COLUMNS`].
pub(in crate::cli) struct VertexNames<'a> {
    /// Per vertex; `None`: the file gives none.
    numbers: Vec<Option<u32>>,
    positions: &'a [[f32; 3]],
}

impl<'a> VertexNames<'a> {
    /// Headings of [`Self::fields`].
    pub(in crate::cli) const COLUMNS: &'static str = "model_vertex,x,y,z";

    /// Of a model as it was named, and its vertices.
    pub(in crate::cli) fn new(model: &Path, vertices: &'a Vertices) -> Self {
        let (numbers, positions) = (vertex_numbers(model), vertices.positions());
        let number = |((triangle, _), &place): ((u32, usize), _)| numbers.as_ref()?.at(triangle, place);
        Self { numbers: vertices.first_corners().into_iter().zip(positions).map(number).collect(), positions }
    }

    /// The number in the model's file: of an OBJ the line `v`, counted from 1, that the first face at the vertex names.
    /// Vertices with several normals, textures or materials at one line have its number all.
    pub(in crate::cli) fn number(&self, vertex: usize) -> Option<u32> {
        self.numbers[vertex]
    }

    /// All numbers.
    pub(in crate::cli) fn numbers(&self) -> Vec<Option<u32>> {
        self.numbers.clone()
    }

    /// The fields of a vertex in a table; the first is empty where the file gives no number.
    pub(in crate::cli) fn fields(&self, vertex: usize) -> String {
        let number = self.number(vertex).map_or_else(String::new, |number| number.to_string());
        let [x, y, z] = self.positions[vertex];
        format!("{number},{x},{y},{z}")
    }

    /// [`Self::fields`] as cells.
    pub(in crate::cli) fn cells(&self, vertex: usize) -> [Cell; 4] {
        let [x, y, z] = self.positions[vertex].map(Cell::from);
        [self.number(vertex).map_or(Cell::Empty, Cell::from), x, y, z]
    }

    /// The name of a vertex in a sentence: `vertex 7 of the model, at 0.5,0,1`.
    pub(in crate::cli) fn phrase(&self, vertex: usize) -> String {
        let [x, y, z] = self.positions[vertex];
        let number = self.number(vertex).map_or_else(String::new, |number| format!("vertex {number} of the model, "));
        format!("{number}at {x},{y},{z}")
    }

    /// Number and place for machines.
    pub(in crate::cli) fn document(&self, vertex: usize) -> Value {
        json!({ "model_vertex": self.number(vertex), "position": self.positions[vertex] })
    }
}
