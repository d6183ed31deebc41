//! The triangle octree (section 5.3), traversed as in Revelles, Urena and Lastra, "An Efficient Parametric Algorithm
//! for Octree Traversal" (2000): from the root down, using only the parameters at which the ray meets the planes of a
//! cell.
//!
//! **No hit is lost.** A cell lists every triangle that touches the closed cell grown by [`Octree::margin`], which is
//! larger than the rounding error of a plane's parameter. So a ray on the common plane, edge or corner of two cells may
//! be assigned to either: both list the triangles hit there. A direction component of -0 counts as +0.

mod beam;
mod build;
mod cells;
mod compact;
mod overlap;
mod traverse;

pub use beam::{Beam, BeamCells};
pub use cells::{CellId, GpuCells};
pub(super) use compact::{Compact, Waiting};
pub use traverse::{Flow, TraversalCounts, Visit};

use glam::DVec3;

/// Criteria for splitting a cell in eight.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OctreeParameters {
    /// Maximum number of triangles of a cell that is not split.
    pub most_triangles: usize,
    /// Maximum depth: splits between the root and the smallest cell, at most 20.
    pub most_depth: u32,
}

impl Default for OctreeParameters {
    /// Tuned for [`HostTracer`](super::HostTracer), which tests eight triangles at a time: with 16 triangles per leaf
    /// instead of 8, there are fewer cells and fewer cache misses.
    fn default() -> Self {
        Self { most_triangles: 16, most_depth: 10 }
    }
}

/// Maximum depth of a cell.
pub const MAX_DEPTH: u32 = 20;

/// Node: eight consecutive children, or a list of triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum OctreeNode {
    /// Index of the first child. In a child's number, bit 2 is set for the upper half in x, bit 1 in y, bit 0 in z.
    Inner(u32),
    /// Start of the leaf's triangles in the list, and their number.
    Leaf(u32, u32),
}

/// Octree over the triangles of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Octree {
    /// Lower corner of the root, a cube.
    corner: DVec3,
    /// Side of the root.
    size: f64,
    margin: f64,
    nodes: Vec<OctreeNode>,
    triangles: Vec<u32>,
}

impl Octree {
    /// Distance outside a cell within which the cell still lists triangles, in scene units.
    pub fn margin(&self) -> f64 {
        self.margin
    }

    /// Number of cells that are not split.
    pub fn leaves(&self) -> usize {
        self.nodes.iter().filter(|node| matches!(node, OctreeNode::Leaf(..))).count()
    }

    /// Triangles of a node's own list, in ascending order; empty for a cell that is split.
    fn list(&self, node: u32) -> &[u32] {
        match self.nodes.get(node as usize) {
            Some(OctreeNode::Leaf(first, count)) => &self.triangles[*first as usize..(*first + *count) as usize],
            _ => &[],
        }
    }
}
