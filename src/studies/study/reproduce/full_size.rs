//! Models and parameters of runs at full size.

use super::StudyError;
use super::shared::{Shared, SharedResult};
use crate::geom::Mesh;
use crate::geom::teapot::teapot;
use crate::scene::built::flat_models::FlatModel;
use crate::scene::built::transfer_models::TransferModel;

/// Inputs of an entry whose rows depend on the size of models.
#[derive(Clone, Copy, Debug)]
pub(super) struct FullSize {
    pub(super) models: &'static [FullModel],
    /// Parameters that only runs at full size have.
    pub(super) parameters: fn() -> String,
}

/// Model at full size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum FullModel {
    Transfer(TransferModel),
    Flat(FlatModel),
    Teapot,
}

impl FullModel {
    pub(super) fn name(self) -> String {
        match self {
            Self::Transfer(model) => format!("{model:?}"),
            Self::Flat(model) => format!("{model:?}"),
            Self::Teapot => "Teapot".to_owned(),
        }
    }
}

/// Mesh at full size.
impl SharedResult for Mesh {
    type Key = FullModel;

    fn compute(model: &FullModel, _: &Shared) -> Result<Self, StudyError> {
        Ok(match model {
            FullModel::Transfer(model) => model.mesh(1),
            FullModel::Flat(model) => model.model(1).mesh,
            FullModel::Teapot => teapot(40).map_err(|error| StudyError::coded("reproduce::record", error))?,
        })
    }
}
