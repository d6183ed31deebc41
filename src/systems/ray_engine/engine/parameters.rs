//! Parameters of an engine; none of them changes an fp32 hit.

use std::ops::RangeInclusive;

use crate::geom::exact::Sides;
use crate::ray_engine::ray_tree::RayTreeParameters;
use crate::tracer::octree::OctreeParameters;

/// Read-back mode: when the host takes the results of a pass on the card (Table 3).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Readback {
    /// Draw, wait, read back, continue, as `glReadPixels` does.
    #[default]
    Synchronous,
    /// The read-back is queued after the draw, with a fence (NV_fence) that is passed when the results have arrived.
    /// The rays stay in flight while the host continues. The host takes results after it has given `passes` later
    /// passes to the card, or if no other work is left. 0 counts as 1.
    Asynchronous {
        /// Maximum number of passes in flight while the host continues.
        passes: usize,
    },
    /// Passes take no time: the log contains only the host's work, in the order of [`Readback::Synchronous`].
    InfinitelyFast,
}

/// Scheduling parameters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EngineParameters {
    /// Parameters of the triangle octree.
    pub octree: OctreeParameters,
    /// Triangles of a GPU cell, from `T_min` to the maximum of one pass (Table 4: 5 to 15).
    pub triangles: RangeInclusive<usize>,
    /// Number of rays at which a cell's cache is sent to the card (`R_min`), which is also the maximum of one pass
    /// (Table 5: 64).
    pub rays: usize,
    /// Parameters of the ray tree.
    pub tree: RayTreeParameters,
    /// Number of rays in the tree above which buckets leave it.
    pub waiting: usize,
    /// Faces that can be hit.
    pub sides: Sides,
    /// `true` to use the card; otherwise the host does all tests in the same order.
    pub card: bool,
    /// Read-back mode.
    pub readback: Readback,
    /// `true` to cull, in the vertex program, triangles that no ray of a pass can hit.
    pub cull: bool,
    /// `true` to test each bucket that leaves the tree as one beam first, against the octree's cells.
    pub beams: bool,
    /// Seed of the random order in which the rays of a bundle enter the tree (section 5.3); `None` keeps their order.
    pub shuffle: Option<u64>,
    /// `true` to record the log of the run.
    pub record: bool,
}

impl Default for EngineParameters {
    fn default() -> Self {
        Self {
            // Tuned for testing triangles one by one, as in the paper.
            octree: OctreeParameters { most_triangles: 8, most_depth: 10 },
            triangles: 5..=15,
            rays: 64,
            tree: RayTreeParameters::default(),
            waiting: 1 << 16,
            sides: Sides::Front,
            card: true,
            readback: Readback::default(),
            cull: true,
            beams: true,
            shuffle: Some(1),
            record: false,
        }
    }
}
