//! Model of Figure 6.

use super::super::models::ModelVisibility;
use super::{HOST, SCENES, StudyError, failed};
use crate::bi_scale::directions::LocalDirections;
use crate::bi_scale::matrix::SparseMatrix;
use crate::geom::Mesh;
use crate::transfer::visibility::Horizon;

/// Stand-in for the chair, with its transfer to local directions.
pub(super) struct ChairModel {
    pub(super) seen: ModelVisibility,
    pub(super) directions: LocalDirections,
    pub(super) matrix: SparseMatrix,
}

impl ChairModel {
    pub(super) fn new(mesh: &Mesh) -> Result<Self, StudyError> {
        let seen = ModelVisibility::new(mesh, Horizon::Normal)?;
        let directions = LocalDirections::new(SCENES[2].side).map_err(|error| failed(HOST)(&error))?;
        let matrix = seen.matrix(SCENES[2].side)?;
        Ok(Self { seen, directions, matrix })
    }
}
