//! What comes of a batch: its hits, or why there are none.

use refsim::event::{DrawEvents, Event};
use refsim::machine::MachineError;

use super::RayBatchError;
use crate::card::KernelError;
use crate::geom::Hit;

/// Triangle ids are 24-bit colors.
pub(super) const MAX_TRIANGLES: usize = 1 << 24;

/// A card cannot intersect rays with triangles.
#[non_exhaustive]
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum EngineError {
    /// The card's shader versions have no intersection program.
    #[error("device `{device}` runs no intersection program: expected ps_1_4 or ps_2_0")]
    #[diagnostic(code(ray_engine::no_kernel), help("take r200, r300, r350, nv30, nv35 or ideal-<format>"))]
    NoKernel { device: String },
    /// The device refuses a program.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Kernel(#[from] KernelError),
    /// More triangles than ids.
    #[error("expected at most {MAX_TRIANGLES} triangles (ids are 24-bit colors), found {found}")]
    #[diagnostic(code(ray_engine::too_many_triangles), help("split the mesh"))]
    TooManyTriangles { found: usize },
    /// Rays that fill no rectangle.
    #[error(transparent)]
    #[diagnostic(code(ray_engine::batch))]
    Batch(#[from] RayBatchError),
    /// The card refuses a resource or a draw.
    #[error("the card refuses the work")]
    #[diagnostic(code(ray_engine::machine))]
    Machine(#[from] MachineError),
}

/// The result of a batch.
#[derive(Clone, Debug)]
pub struct Answer {
    /// The hit of each ray.
    pub hits: Vec<Option<Hit>>,
    /// What happened on the card.
    pub events: DrawEvents,
    /// The pixel program that ran.
    pub kernel: &'static str,
    /// The log of the card; empty unless it was recorded.
    pub log: Vec<Event>,
}
