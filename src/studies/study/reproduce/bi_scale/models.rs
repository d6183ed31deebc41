//! Stand-ins for the paper's models: visibility at their vertices, transfer to local directions, biclusters.

use std::cell::OnceCell;

use super::{HOST, ReproduceError, failed, get_or_try};
use crate::bi_scale::bicluster::{BiclusterOptions, Biclustering, bicluster};
use crate::bi_scale::directions::LocalDirections;
use crate::bi_scale::matrix::SparseMatrix;
use crate::bi_scale::transfer::transfer_matrix;
use crate::geom::{Mesh, Sides};
use crate::scene::built::transfer_models::TransferModel;
use crate::tracer::HostTracer;
use crate::transfer::visibility::{Horizon, VisibilityMaps, VisibilitySampling};
use crate::transfer::{Tangents, Vertices};

/// Base-2 logarithm of the visibility samples along an edge of a light texel.
pub(super) const LOG2_SAMPLES: u32 = 1;

/// Model with the visibility at its vertices.
#[derive(Debug)]
pub(super) struct ModelVisibility {
    pub(super) mesh: Mesh,
    pub(super) vertices: Vertices,
    maps: VisibilityMaps,
}

/// Transfer as biclusters.
#[derive(Debug)]
pub(super) struct ClusteredModel {
    pub(super) nonzeros: usize,
    pub(super) biclusters: Biclustering,
}

/// Intermediate results that entries share, for the small bunny.
#[derive(Debug, Default)]
pub(in crate::study::reproduce) struct BiScaleShared {
    seen: OnceCell<ModelVisibility>,
    biclusters: OnceCell<ClusteredModel>,
}

impl BiScaleShared {
    /// Bunny of both tables, with visibility by its triangles alone.
    pub(super) fn bunny(&self) -> Result<&ModelVisibility, ReproduceError> {
        get_or_try(&self.seen, || ModelVisibility::new(&TransferModel::BiScaleBunny.mesh(1), Horizon::Geometry))
    }

    /// Its biclusters with the directions of both tables.
    pub(super) fn biclusters(&self) -> Result<&ClusteredModel, ReproduceError> {
        get_or_try(&self.biclusters, || self.bunny()?.clustered(super::scenes::SCENES[0].side))
    }
}

impl ModelVisibility {
    pub(super) fn new(mesh: &Mesh, horizon: Horizon) -> Result<Self, ReproduceError> {
        let vertices = Vertices::new(mesh, Tangents::Texture).map_err(|error| failed(HOST)(&error))?;
        let all: Vec<u32> = (0..vertices.len() as u32).collect();
        let sampling = VisibilitySampling { log2_samples: LOG2_SAMPLES, horizon };
        let mut caster = HostTracer::new(mesh, Sides::Both);
        let maps = VisibilityMaps::trace_sampled(&vertices, &all, sampling, &mut caster, &mut |_, _| ())
            .map_err(|error| failed(HOST)(&error))?;
        Ok(Self { mesh: mesh.clone(), vertices, maps })
    }

    /// Transfer matrix T with `side` local directions along an edge.
    pub(super) fn matrix(&self, side: usize) -> Result<SparseMatrix, ReproduceError> {
        let directions = LocalDirections::new(side).map_err(|error| failed(HOST)(&error))?;
        transfer_matrix(&self.vertices, &self.maps, &directions).map_err(|error| failed(HOST)(&error))
    }

    pub(super) fn clustered(&self, side: usize) -> Result<ClusteredModel, ReproduceError> {
        let matrix = self.matrix(side)?;
        let biclusters =
            bicluster(&matrix, BiclusterOptions::default(), &mut |_| ()).map_err(|error| failed(HOST)(&error))?;
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
