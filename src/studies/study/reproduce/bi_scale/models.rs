//! Stand-ins for the paper's models: visibility at their vertices, transfer to local directions, biclusters.

use glam::DVec3;

use super::scenes::SCENES;
use super::{HOST, RunResult, Shared, StudyError};
use crate::bi_scale::bicluster::{Biclustering, SEED, bicluster};
use crate::bi_scale::directions::LocalDirections;
use crate::bi_scale::matrix::SparseMatrix;
use crate::bi_scale::transfer::transfer_matrix;
use crate::geom::vector::wide;
use crate::geom::{Mesh, Sides};
use crate::scene::Camera;
use crate::scene::built::transfer_models::TransferModel;
use crate::study::framing::framed;
use crate::study::reproduce::shared::SharedResult;
use crate::tracer::HostTracer;
use crate::transfer::visibility::{Horizon, VisibilityMaps, VisibilitySampling};
use crate::transfer::{Tangents, Vertices};

pub(super) const BUNNY: TransferModel = TransferModel::BiScaleBunny;
/// Base-2 logarithm of the number of visibility samples per side of a light texel.
pub(super) const LOG2_SAMPLES: u32 = 1;

/// Position of the eye, in units of the model's size, relative to its center.
const EYE: DVec3 = DVec3::new(1.6, -2.4, 0.9);

/// Model with the visibility at its vertices.
#[derive(Debug)]
pub(super) struct ModelVisibility {
    pub(super) mesh: Mesh,
    pub(super) vertices: Vertices,
    maps: VisibilityMaps,
}

#[derive(Debug)]
pub(super) struct ClusteredModel {
    pub(super) nonzeros: usize,
    pub(super) biclusters: Biclustering,
}

/// Camera of a picture that a model fills.
pub(super) fn filled(mesh: &Mesh, [width, height]: [u32; 2]) -> Result<Camera, StudyError> {
    let [low, high] = mesh.bounds().unwrap_or_default().map(wide);
    let (middle, size) = ((low + high) / 2.0, (high - low).max_element());
    let points: Vec<DVec3> = mesh.positions().iter().map(|&at| wide(at)).collect();
    let view = framed(middle + size * EYE, &points, f64::from(width) / f64::from(height));
    view.camera(width, height).on(HOST)
}

/// Visibility by the triangles of a model alone.
impl SharedResult for ModelVisibility {
    type Key = TransferModel;

    fn compute(model: &TransferModel, _: &Shared) -> Result<Self, StudyError> {
        Self::new(&model.mesh(1), Horizon::Geometry)
    }
}

/// Biclusters of a model's transfer, with the directions that both tables use.
impl SharedResult for ClusteredModel {
    type Key = TransferModel;

    fn compute(&model: &TransferModel, shared: &Shared) -> Result<Self, StudyError> {
        shared.get::<ModelVisibility>(model)?.clustered(SCENES[0].side)
    }
}

impl ModelVisibility {
    pub(super) fn new(mesh: &Mesh, horizon: Horizon) -> Result<Self, StudyError> {
        let vertices = Vertices::new(mesh, Tangents::Texture).on(HOST)?;
        let all: Vec<u32> = (0..vertices.len() as u32).collect();
        let sampling = VisibilitySampling { log2_samples: LOG2_SAMPLES, horizon };
        let mut caster = HostTracer::new(mesh, Sides::Both);
        let maps = VisibilityMaps::trace_sampled(&vertices, &all, sampling, &mut caster, &mut |_, _| ()).on(HOST)?;
        Ok(Self { mesh: mesh.clone(), vertices, maps })
    }

    /// Transfer matrix T with `side` local directions per side.
    pub(super) fn matrix(&self, side: usize) -> Result<SparseMatrix, StudyError> {
        let directions = LocalDirections::new(side).on(HOST)?;
        transfer_matrix(&self.vertices, &self.maps, &directions).on(HOST)
    }

    pub(super) fn clustered(&self, side: usize) -> Result<ClusteredModel, StudyError> {
        let matrix = self.matrix(side)?;
        let biclusters = bicluster(&matrix, SEED, &mut |_| ()).on(HOST)?;
        Ok(ClusteredModel { nonzeros: matrix.nonzeros(), biclusters })
    }
}

impl ClusteredModel {
    /// Megabytes of the biclusters: four bytes per row, eight per column.
    pub(super) fn megabytes(&self) -> f64 {
        4e-6 * (self.biclusters.row_entries() + 2 * self.biclusters.column_entries()) as f64
    }

    pub(super) fn operations_left(&self) -> f64 {
        100.0 * self.biclusters.cost() as f64 / (2 * self.nonzeros) as f64
    }
}
