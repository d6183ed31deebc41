//! Counters of an engine.

use crate::ray_engine::ray_tree::RayTreeCounts;
use crate::tracer::octree::TraversalCounts;

/// Counters of an engine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EngineCounts {
    /// Number of rays answered.
    pub rays: u64,
    /// Rays that were tested on the card at least once.
    pub rays_on_card: u64,
    /// Number of passes on the card.
    pub passes: u64,
    /// Number of rays of all passes.
    pub pass_rays: u64,
    /// Ray-triangle tests of all passes: rays times triangles.
    pub pass_tests: u64,
    /// Number of triangles of all passes.
    pub pass_triangles: u64,
    /// Triangles of all passes that the vertex program moved off the screen.
    pub culled: u64,
    /// Rays left in caches and tested on the host at the end.
    pub forced_rays: u64,
    /// Number of ray-triangle tests on the host.
    pub host_tests: u64,
    /// Cells tested against whole buckets of rays.
    pub beam_cells: u64,
    /// Rays of buckets that meet no cell with triangles, answered at once.
    pub beam_rays: u64,
    /// Counters of the octree.
    pub traversal: TraversalCounts,
    /// Counters of the ray tree.
    pub tree: RayTreeCounts,
}

impl EngineCounts {
    /// Fraction of rays tested on the card at least once, in [0, 1], which is one reading of Table 2.
    pub fn share_on_card(&self) -> f64 {
        self.rays_on_card as f64 / self.rays.max(1) as f64
    }

    /// Fraction of rays' visits to GPU cells' caches that ended on the card, in [0, 1], which is the other reading of
    /// Table 2. Other visits were forced to the host. A ray that visits several caches counts several times.
    pub fn share_of_visits_on_card(&self) -> f64 {
        self.pass_rays as f64 / (self.pass_rays + self.forced_rays).max(1) as f64
    }
}
