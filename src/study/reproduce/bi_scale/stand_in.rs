//! Models that stand for the paper's, and their transfer.

use super::{HOST, ReproduceError, failed};
use crate::geom::{Mesh, Sides};
use crate::prt::all_frequency::visibility::{Horizon, VisibilityMaps, VisibilitySampling};
use crate::prt::bi_scale::directions::LocalDirections;
use crate::prt::bi_scale::matrix::SparseMatrix;
use crate::prt::bi_scale::transfer::transfer_matrix;
use crate::prt::transfer::{Tangents, Vertices};
use crate::tracer::HostTracer;

/// Visibility samples along an edge of a light texel, as a power of two.
pub(super) const LOG2_SAMPLES: u32 = 1;

/// A model with its transfer to local directions.
pub(super) struct StandIn {
    pub(super) mesh: Mesh,
    pub(super) vertices: Vertices,
    pub(super) directions: LocalDirections,
    pub(super) matrix: SparseMatrix,
}

impl StandIn {
    /// Of a mesh, to so many local directions along an edge.
    pub(super) fn new(mesh: Mesh, side: usize, horizon: Horizon) -> Result<Self, ReproduceError> {
        let vertices = Vertices::new(&mesh, Tangents::Texture).map_err(|error| failed(HOST)(&error))?;
        let all: Vec<u32> = (0..vertices.len() as u32).collect();
        let sampling = VisibilitySampling { log2_samples: LOG2_SAMPLES, horizon };
        let mut caster = HostTracer::new(&mesh, Sides::Both);
        let maps = VisibilityMaps::trace_sampled(&vertices, &all, sampling, &mut caster, &mut |_, _| ())
            .map_err(|error| failed(HOST)(&error))?;
        let directions = LocalDirections::new(side).map_err(|error| failed(HOST)(&error))?;
        let matrix = transfer_matrix(&vertices, &maps, &directions).map_err(|error| failed(HOST)(&error))?;
        Ok(Self { mesh, vertices, directions, matrix })
    }
}
