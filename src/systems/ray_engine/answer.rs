//! Results and errors of a batch of rays.

use refsim::event::{DrawEvents, Event};
use refsim::machine::MachineError;

use crate::card::KernelError;
use crate::error::InputError;
use crate::geom::Hit;

/// Maximum number of triangles: ids are 24-bit colors.
pub(super) const MAX_TRIANGLES: usize = 1 << 24;

/// Error of an intersection on a card.
#[non_exhaustive]
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[expect(missing_docs, reason = "the messages explain the fields")]
pub enum EngineError {
    /// The device runs none of the shader versions that the intersection programs are written in.
    #[error("device `{device}` runs no intersection program: expected ps_1_4 or ps_2_0")]
    #[diagnostic(code(ray_engine::no_kernel), help("use r200, r300, r350, nv30, nv35 or ideal-<format>"))]
    NoKernel { device: String },
    /// Seven vectors and the coordinates of a texture do not fit into the six coordinate sets of ps_1_4.
    #[error(
        "device `{device}` has no program with shared edges for rays of more than one origin: it would take two passes"
    )]
    #[diagnostic(
        code(ray_engine::no_shared_edges),
        help("give the rays one origin, or use a device with ps_2_0: r300, r350, nv30, nv35")
    )]
    NoSharedEdges { device: String },
    /// The only program for rays stored as bytes is a ps_1_4 program for front faces.
    #[error("device `{device}` has no program for rays stored as bytes and for these faces")]
    #[diagnostic(
        code(ray_engine::no_byte_rays),
        help("use front faces, and a device with ps_1_4 and fixed point such as r200")
    )]
    NoByteRays { device: String },
    /// The device rejects a program.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Kernel(#[from] KernelError),
    /// The mesh has more triangles than there are ids.
    #[error("expected at most {MAX_TRIANGLES} triangles (ids are 24-bit colors), found {found}")]
    #[diagnostic(code(ray_engine::too_many_triangles), help("split the mesh"))]
    TooManyTriangles { found: usize },
    /// The number of rays does not match the rectangle.
    #[error(transparent)]
    #[diagnostic(code(ray_engine::batch))]
    Batch(#[from] InputError),
    /// The card rejects a resource or a draw.
    #[error("the card refuses the work")]
    #[diagnostic(code(ray_engine::machine))]
    Machine(#[from] MachineError),
}

/// Result of a batch.
#[derive(Clone, Debug)]
pub struct Answer {
    /// First hit of each ray, in the order of the rays; `None` for a miss.
    pub hits: Vec<Option<Hit>>,
    /// Events counted by the card.
    pub events: DrawEvents,
    /// File name of the pixel program that ran.
    pub kernel: &'static str,
    /// Event log of the card; empty unless it was recorded.
    pub log: Vec<Event>,
}

impl Answer {
    /// Answer without hits, for rays that need no work on the card.
    pub(super) fn without_hits(rays: usize, kernel: &'static str) -> Self {
        Self { hits: vec![None; rays], events: DrawEvents::default(), kernel, log: Vec::new() }
    }
}
