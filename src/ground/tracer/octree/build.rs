//! Construction of the octree.

use glam::DVec3;

use super::overlap::touches;
use super::{MAX_DEPTH, Octree, OctreeNode, OctreeParameters};
use crate::geom::Mesh;
use crate::geom::vector::wide;

/// Growth of a cell for its list of triangles, relative to the side of the root and to the magnitudes of coordinates: a
/// few units in the last place of fp32.
const MARGIN: f64 = 5e-7;
/// Relative growth of the root over the mesh's bounds, so that no triangle lies on the root's outer planes.
const ROOT_MARGIN: f64 = 1e-3;
/// Maximum number of consecutive useless levels: splits that leave a child with all of its parent's triangles.
const MAX_USELESS_LEVELS: u32 = 3;

struct OctreeBuilder {
    corners: Vec<[DVec3; 3]>,
    parameters: OctreeParameters,
    margin: f64,
    octree: Octree,
}

impl Octree {
    /// Builds an octree over a mesh. An empty mesh gives a root without triangles.
    pub fn new(mesh: &Mesh, parameters: OctreeParameters) -> Self {
        let [low, high] = mesh.bounds().unwrap_or_default().map(wide);
        let widest = (high - low).max_element();
        let magnitude = low.abs().max(high.abs()).max_element();
        // A root of size 0 cannot be split, so a mesh that is a single point gets a larger one.
        let size =
            (widest * (1.0 + ROOT_MARGIN) + magnitude * ROOT_MARGIN * ROOT_MARGIN).max(f64::from(f32::MIN_POSITIVE));
        let corner = (low + high) / 2.0 - size / 2.0;
        let margin = MARGIN * (size + magnitude);
        let octree = Self { corner, size, margin, nodes: vec![OctreeNode::Leaf(0, 0)], triangles: Vec::new() };
        let corners =
            (0..mesh.len() as u32).filter_map(|id| mesh.corners(id)).map(|corners| corners.map(wide)).collect();
        let mut builder = OctreeBuilder { corners, parameters, margin, octree };
        let all = (0..builder.corners.len() as u32).collect();
        let middle = corner + size / 2.0;
        builder.fill(0, middle, size / 2.0, all, 0, 0);
        builder.octree
    }
}

impl OctreeBuilder {
    /// Makes `node` a leaf of these triangles, or splits it. `useless` counts the consecutive useless levels directly
    /// above `node`.
    fn fill(&mut self, node: usize, middle: DVec3, half: f64, inside: Vec<u32>, depth: u32, useless: u32) {
        let deepest = self.parameters.most_depth.min(MAX_DEPTH);
        // Cells about as small as the margin do not separate triangles better than their parents.
        let small = half < 4.0 * self.margin;
        if inside.len() <= self.parameters.most_triangles || depth >= deepest || useless >= MAX_USELESS_LEVELS || small
        {
            let first = self.octree.triangles.len() as u32;
            self.octree.nodes[node] = OctreeNode::Leaf(first, inside.len() as u32);
            self.octree.triangles.extend(inside);
            return;
        }
        let first = self.octree.nodes.len();
        self.octree.nodes[node] = OctreeNode::Inner(first as u32);
        self.octree.nodes.extend([OctreeNode::Leaf(0, 0); 8]);
        for child in 0..8 {
            let quarter = half / 2.0;
            let side = |bit: usize| if child >> bit & 1 == 1 { quarter } else { -quarter };
            let middle = middle + DVec3::new(side(2), side(1), side(0));
            let grown = DVec3::splat(quarter + self.margin);
            let touching = |id: &u32| touches(&self.from(*id, middle), grown);
            let list: Vec<u32> = inside.iter().copied().filter(touching).collect();
            let useless = if list.len() == inside.len() { useless + 1 } else { 0 };
            self.fill(first + child, middle, quarter, list, depth + 1, useless);
        }
    }

    fn from(&self, id: u32, point: DVec3) -> [DVec3; 3] {
        let [a, b, c] = self.corners[id as usize];
        [a - point, b - point, c - point]
    }
}
