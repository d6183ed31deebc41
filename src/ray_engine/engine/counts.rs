//! What an engine did, in numbers.

use crate::ray_engine::ray_tree::RayTreeCounts;
use crate::tracer::octree::TraversalCounts;

/// What an engine did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EngineCounts {
    /// Rays answered.
    pub rays: u64,
    /// Rays that met the card at least once on their way.
    pub rays_on_card: u64,
    /// Passes on the card.
    pub passes: u64,
    /// Rays of all passes.
    pub pass_rays: u64,
    /// Ray-triangle tests of all passes: rays times triangles.
    pub pass_tests: u64,
    /// Triangles of all passes.
    pub pass_triangles: u64,
    /// Those of them that the vertex program moved off the screen.
    pub culled: u64,
    /// Rays in caches that were forced to the host in the end.
    pub forced_rays: u64,
    /// Ray-triangle tests on the host.
    pub host_tests: u64,
    /// Cells tested against whole buckets of rays.
    pub beam_cells: u64,
    /// Rays of buckets that meet no cell with triangles: answered at once.
    pub beam_rays: u64,
    /// The octree's.
    pub traversal: TraversalCounts,
    /// The ray tree's.
    pub tree: RayTreeCounts,
}

impl EngineCounts {
    /// The share of rays that met the card at least once: one reading of Table 2.
    pub fn share_on_card(&self) -> f64 {
        self.rays_on_card as f64 / self.rays.max(1) as f64
    }

    /// Of all visits of rays to the caches of GPU cells, the share that ended on the card; the others were forced to
    /// the host. The other reading of Table 2. A ray that visits several caches counts several times.
    pub fn share_of_visits_on_card(&self) -> f64 {
        self.pass_rays as f64 / (self.pass_rays + self.forced_rays).max(1) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_two_readings_of_table_2() {
        // Three of four rays met the card, in six visits; two visits ended on the host.
        let counts = EngineCounts { rays: 4, rays_on_card: 3, pass_rays: 6, forced_rays: 2, ..EngineCounts::default() };
        assert_eq!((counts.share_on_card(), counts.share_of_visits_on_card()), (0.75, 0.75));
        assert_eq!(EngineCounts { forced_rays: 6, ..counts }.share_of_visits_on_card(), 0.5);
        assert_eq!(EngineCounts::default().share_of_visits_on_card(), 0.0, "no visits at all");
    }
}
