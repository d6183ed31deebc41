//! Which vertex of a file a verb shows.

use std::path::{Path, PathBuf};

use super::model::nearest;
use super::vertex_names::VertexNames;
use crate::cli::Problem;
use crate::options::number;
use crate::transfer::Vertices;

/// A vertex by its number or by its place.
#[derive(Debug, clap::Args)]
pub(in crate::cli) struct VertexChoice {
    /// A vertex, counted from 0
    #[arg(long, value_name = "N", group = "which")]
    vertex: Option<u32>,

    /// The vertex nearest to this place of the model
    #[arg(long, value_name = "X,Y,Z", value_parser = number::point, requires = "model", group = "which",
          allow_hyphen_values = true)]
    at: Option<[f32; 3]>,

    /// The model that the file was made from: it says where the vertex is, and its number in the model's file
    #[arg(long, value_name = "MODEL", requires = "which")]
    model: Option<PathBuf>,
}

impl VertexChoice {
    /// The model, if one is named.
    pub(in crate::cli) fn model(&self) -> Option<&Path> {
        self.model.as_deref()
    }

    /// The vertex that is asked for, if one is, below `count`; `vertices` are those of the model.
    pub(in crate::cli) fn chosen(
        &self,
        command: &str,
        count: usize,
        vertices: Option<&Vertices>,
    ) -> Result<Option<usize>, Problem> {
        let nearest = || nearest(vertices?.positions(), self.at?);
        let vertex = self.vertex.map(|vertex| vertex as usize).or_else(nearest);
        if let Some(vertex) = vertex.filter(|&vertex| vertex >= count) {
            let what = format!("expected a vertex below {count} (counted from 0), found {vertex}");
            return Err(Problem::usage(what, format!("`crossbar {command} show` says how many there are")));
        }
        Ok(vertex)
    }

    /// Names of the model's vertices.
    pub(in crate::cli) fn names<'a>(&self, vertices: Option<&'a Vertices>) -> Option<VertexNames<'a>> {
        Some(VertexNames::new(self.model()?, vertices?))
    }
}
