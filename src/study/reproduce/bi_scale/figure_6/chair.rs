//! Model of Figure 6.

use super::super::models::ModelVisibility;
use super::{HOST, ReproduceError, SCENES, failed};
use crate::geom::Mesh;
use crate::prt::all_frequency::visibility::Horizon;
use crate::prt::bi_scale::directions::LocalDirections;
use crate::prt::bi_scale::matrix::SparseMatrix;

/// Stand-in for the chair, with its transfer to local directions.
pub(super) struct ChairModel {
    pub(super) seen: ModelVisibility,
    pub(super) directions: LocalDirections,
    pub(super) matrix: SparseMatrix,
}

impl ChairModel {
    pub(super) fn new(mesh: &Mesh) -> Result<Self, ReproduceError> {
        let seen = ModelVisibility::new(mesh, Horizon::Normal)?;
        let directions = LocalDirections::new(SCENES[2].side).map_err(|error| failed(HOST)(&error))?;
        let matrix = seen.matrix(SCENES[2].side)?;
        Ok(Self { seen, directions, matrix })
    }
}
