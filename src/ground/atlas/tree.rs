//! Binary tree of clusters.

use super::graph::FaceGraph;
use super::measures::FaceMeasures;
use super::{small, sweep};

/// Minimum number of faces of a cluster whose halves are processed in parallel.
const SIDE_BY_SIDE: usize = 2048;

/// Node of the tree: a cluster of faces and its rectangle of texels.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ClusterNode {
    /// Start of its faces in [`ClusterTree::order`].
    pub first: u32,
    /// Number of its faces.
    pub faces: u32,
    /// Column of its first texel.
    pub x: u32,
    /// Row of its first texel.
    pub y: u32,
    /// Texels per row.
    pub width: u32,
    /// Number of rows: `width` or twice `width`.
    pub height: u32,
}

/// Binary tree of clusters with one face per leaf: 2 T - 1 nodes for T faces.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ClusterTree {
    nodes: Vec<ClusterNode>,
    order: Vec<u32>,
}

impl ClusterTree {
    /// Builds the tree of a graph's faces (at least one) over a square with at least one texel per face.
    pub(super) fn new(graph: FaceGraph, measures: &FaceMeasures, side: u32) -> Self {
        let count = graph.len();
        let mut nodes = vec![ClusterNode::default(); 2 * count - 1];
        let mut order = vec![0; count];
        let root = ClusterNode { first: 0, faces: count as u32, x: 0, y: 0, width: side, height: side };
        grow(graph, measures, root, &mut nodes, &mut order);
        Self { nodes, order }
    }

    /// All nodes in depth-first order: the root, its first subtree, its second subtree.
    pub fn nodes(&self) -> &[ClusterNode] {
        &self.nodes
    }

    /// Faces in the order of the leaves; the faces of a node are contiguous.
    pub fn order(&self) -> &[u32] {
        &self.order
    }

    /// Faces of a node.
    pub fn faces(&self, node: &ClusterNode) -> &[u32] {
        self.order.get(node.first as usize..).and_then(|from| from.get(..node.faces as usize)).unwrap_or_default()
    }

    /// Children of a node, as indices into [`ClusterTree::nodes`]; `None` for a leaf and beyond the last node.
    pub fn children(&self, node: usize) -> Option<[usize; 2]> {
        let first = node + 1;
        (self.nodes.get(node)?.faces > 1).then(|| [first, first + 2 * self.nodes[first].faces as usize - 1])
    }
}

fn grow(graph: FaceGraph, measures: &FaceMeasures, node: ClusterNode, nodes: &mut [ClusterNode], order: &mut [u32]) {
    nodes[0] = node;
    if graph.len() == 1 {
        order[0] = graph.faces()[0];
        return;
    }
    let capacity = node.width as usize * node.height as usize / 2;
    let [first, second] = graph.halves(&cut(&graph, measures, capacity));
    let side_by_side = graph.len() >= SIDE_BY_SIDE;
    drop(graph);
    let [one, other] = rectangles(node, first.len() as u32);
    let (nodes, other_nodes) = nodes[1..].split_at_mut(2 * first.len() - 1);
    let (order, other_order) = order.split_at_mut(first.len());
    let of_first = || grow(first, measures, one, nodes, order);
    let of_second = || grow(second, measures, other, other_nodes, other_order);
    if side_by_side {
        rayon::join(of_first, of_second);
    } else {
        of_first();
        of_second();
    }
}

/// Splits a cluster of at least two faces into halves with `capacity` texels each: `true` marks the second half.
///
/// Neither half has more faces than texels. Both halves of a connected cluster are connected if such a split is found;
/// within that constraint, their demands are as equal as possible.
fn cut(graph: &FaceGraph, measures: &FaceMeasures, capacity: usize) -> Vec<bool> {
    let count = graph.len();
    let limits = count.saturating_sub(capacity).max(1)..=capacity.min(count - 1);
    if count <= small::MOST {
        return small::cut(graph, measures, limits);
    }
    let (part, parts) = graph.parts(|_| true);
    match parts {
        1 => sweep::cut_connected(graph, measures, limits),
        _ => sweep::cut_parts(graph, measures, limits, &part, parts),
    }
}

/// Children of a node whose first child has `faces` faces: a square is halved in width, a rectangle in height.
fn rectangles(node: ClusterNode, faces: u32) -> [ClusterNode; 2] {
    let (width, height) =
        if node.width == node.height { (node.width / 2, node.height) } else { (node.width, node.height / 2) };
    let first = ClusterNode { faces, width, height, ..node };
    let second = ClusterNode {
        first: node.first + faces,
        faces: node.faces - faces,
        x: node.x + node.width - width,
        y: node.y + node.height - height,
        width,
        height,
    };
    [first, second]
}
