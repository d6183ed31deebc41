//! The triangle octree (section 5.3), traversed after Revelles, Urena and Lastra, "An Efficient Parametric Algorithm
//! for Octree Traversal" (2000): from the root down, with nothing but the parameters at which the ray meets the planes
//! of a cell.
//!
//! **No hit is lost.** A cell lists every triangle that touches the closed cell grown by [`Octree::margin`], which is
//! larger than what rounding can do to a plane's parameter; so whichever of two neighbours a ray on their common plane,
//! edge or corner is said to go through, that one lists what is hit there. Both zeros are one direction.

mod beam;
mod build;
mod cells;
mod compact;
mod overlap;
mod traverse;

pub use beam::{Beam, Reached};
pub use cells::{CellId, GpuCells};
pub(super) use compact::{Compact, Waiting};
pub use traverse::{Flow, TraversalCounts, Visit};

use glam::DVec3;

/// When a cell is cut in eight.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OctreeParameters {
    /// A cell of at most so many triangles stays whole.
    pub most_triangles: usize,
    /// Cuts between the root and the smallest cell, at most; 20 is the most there is.
    pub most_depth: u32,
}

impl Default for OctreeParameters {
    /// Tuned for [`HostTracer`](super::HostTracer), which tests eight triangles at a time: 16 triangles make fewer
    /// cells than 8, and less memory to wait for.
    fn default() -> Self {
        Self { most_triangles: 16, most_depth: 10 }
    }
}

/// The deepest cell there can be.
pub const MAX_DEPTH: u32 = 20;

/// A node: eight children that stand together, or a list of triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum OctreeNode {
    /// The first of the eight. Child number: bit 2 is set for the upper half in x, bit 1 in y, bit 0 in z.
    Inner(u32),
    /// Where its triangles begin in the list, and how many there are.
    Leaf(u32, u32),
}

/// An octree over the triangles of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Octree {
    /// Lower corner of the root, a cube.
    corner: DVec3,
    /// Side of the root.
    size: f64,
    margin: f64,
    nodes: Vec<OctreeNode>,
    triangles: Vec<u32>,
    depth: u32,
}

/// What an octree is made of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct OctreeCounts {
    /// Cells that are cut.
    pub inner: usize,
    /// Cells that are not.
    pub leaves: usize,
    /// Leaves without a triangle.
    pub empty_leaves: usize,
    /// Entries of the lists: a triangle counts once per leaf.
    pub entries: usize,
    /// Triangles of the fullest leaf.
    pub fullest: usize,
    /// Cuts between the root and the smallest cell.
    pub depth: u32,
}

impl Octree {
    /// How far beyond its planes a cell still lists triangles, in scene units.
    pub fn margin(&self) -> f64 {
        self.margin
    }

    /// What it is made of.
    pub fn counts(&self) -> OctreeCounts {
        let mut out = OctreeCounts { depth: self.depth, entries: self.triangles.len(), ..OctreeCounts::default() };
        for node in &self.nodes {
            match node {
                OctreeNode::Inner(_) => out.inner += 1,
                OctreeNode::Leaf(_, count) => {
                    out.leaves += 1;
                    out.empty_leaves += usize::from(*count == 0);
                    out.fullest = out.fullest.max(*count as usize);
                }
            }
        }
        out
    }

    /// The triangles of a node's own list, in rising order; empty for a cell that is cut.
    fn list(&self, node: u32) -> &[u32] {
        match self.nodes.get(node as usize) {
            Some(OctreeNode::Leaf(first, count)) => &self.triangles[*first as usize..(*first + *count) as usize],
            _ => &[],
        }
    }
}
