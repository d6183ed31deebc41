//! What can be chosen about an engine; nothing of it changes a hit of fp32.

use std::ops::RangeInclusive;

use crate::geom::exact::Sides;
use crate::ray_engine::Outputs;
use crate::ray_engine::ray_tree::RayTreeParameters;
use crate::tracer::octree::OctreeParameters;

/// When the results of a pass on the card are taken (Table 3).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Readback {
    /// Draw, wait, read back, go on: what `glReadPixels` does.
    #[default]
    Synchronous,
    /// The results of a pass come by themselves behind its draw, with a fence (NV_fence) that is passed when they are
    /// there. Its rays stay in flight while the host goes on; they are taken when `passes` younger passes have been
    /// given to the card, or when nothing else can go on. 0 is 1.
    Asynchronous {
        /// Passes in flight while the host goes on, at most.
        passes: usize,
    },
    /// Passes cost nothing: the log holds the host's work alone, in the order of [`Readback::Synchronous`].
    InfinitelyFast,
}

/// How the engine schedules.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EngineParameters {
    /// The triangle octree.
    pub octree: OctreeParameters,
    /// Triangles of a GPU cell: `T_min` to the most that one pass draws (Table 4: 5 to 15).
    pub triangles: RangeInclusive<usize>,
    /// Rays at which a cell's cache goes to the card (`R_min`), and which one pass takes at most (Table 5: 64).
    pub rays: usize,
    /// The ray tree.
    pub tree: RayTreeParameters,
    /// Rays that the tree holds before buckets leave it.
    pub waiting: usize,
    /// Which faces can be hit.
    pub sides: Sides,
    /// Whether the card takes part at all; else the host does everything, in the same order.
    pub card: bool,
    /// When the results of a pass are taken.
    pub readback: Readback,
    /// What comes back of a ray.
    pub outputs: Outputs,
    /// Whether triangles come back as places in the pass's list, in the smallest colour target that the card has: one
    /// byte for up to 255 triangles, two for more, four where the card has no such target. Not with barycentric
    /// coordinates.
    pub small_ids: bool,
    /// Whether the vertex program culls triangles that no ray of a pass can hit.
    pub cull: bool,
    /// Whether a bucket that leaves the tree is tested against the octree's cells first, as one beam.
    pub beams: bool,
    /// Rays of a bundle enter the tree in random order (section 5.3), keyed by this seed; `None`: as they come.
    pub shuffle: Option<u64>,
    /// Whether the log of the run is kept.
    pub record: bool,
}

impl Default for EngineParameters {
    fn default() -> Self {
        Self {
            // Triangles one by one, as the paper tests them.
            octree: OctreeParameters { most_triangles: 8, most_depth: 10 },
            triangles: 5..=15,
            rays: 64,
            tree: RayTreeParameters::default(),
            waiting: 1 << 16,
            sides: Sides::Front,
            card: true,
            readback: Readback::default(),
            outputs: Outputs::default(),
            small_ids: false,
            cull: true,
            beams: true,
            shuffle: Some(1),
            record: false,
        }
    }
}
