//! GPU cells: cells with enough triangles for a pass on the card (section 6.2).

use std::ops::RangeInclusive;

use super::{Octree, OctreeNode};

/// Cell of an octree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct CellId(pub(super) u32);

impl CellId {
    /// Cell with this index.
    pub const fn at(index: usize) -> Self {
        Self(index as u32)
    }

    /// Index of the cell, below the number of all cells.
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

/// Cells whose triangles go to the card together: the largest cells of the finished octree whose number of distinct
/// triangles lies in a range (`T` of Table 4). GPU cells are never nested.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GpuCells {
    /// Range of each node's triangles in the list; empty for a node that is not a GPU cell.
    spans: Vec<(u32, u32)>,
    triangles: Vec<u32>,
    count: usize,
}

impl GpuCells {
    /// Marks the cells of `octree` with at least `range.start()` distinct triangles (`T_min` of section 6.1) and at
    /// most `range.end()` (the maximum of one pass).
    pub fn mark(octree: &Octree, range: RangeInclusive<usize>) -> Self {
        let mut cells = Self { spans: vec![(0, 0); octree.nodes.len()], triangles: Vec::new(), count: 0 };
        cells.visit(octree, 0, &range);
        cells
    }

    /// Triangles of a GPU cell in ascending order; `None` for other cells.
    pub fn triangles(&self, cell: CellId) -> Option<&[u32]> {
        let (first, count) = *self.spans.get(cell.index())?;
        (count > 0).then(|| &self.triangles[first as usize..(first + count) as usize])
    }

    /// Number of GPU cells.
    pub fn len(&self) -> usize {
        self.count
    }

    /// Returns `true` if there are no GPU cells.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Iterates over the GPU cells.
    pub fn iter(&self) -> impl Iterator<Item = CellId> + '_ {
        (0_u32..).zip(&self.spans).filter(|(_, span)| span.1 > 0).map(|(i, _)| CellId(i))
    }

    fn visit(&mut self, octree: &Octree, node: u32, range: &RangeInclusive<usize>) {
        let mut all = Vec::new();
        gather(octree, node, &mut all);
        all.sort_unstable();
        all.dedup();
        // GPU cells are not nested, so there are none below.
        if all.len() < *range.start() || all.is_empty() {
            return;
        }
        if range.contains(&all.len()) {
            self.spans[node as usize] = (self.triangles.len() as u32, all.len() as u32);
            self.triangles.extend(all);
            self.count += 1;
            return;
        }
        if let OctreeNode::Inner(first) = octree.nodes[node as usize] {
            for child in first..first + 8 {
                self.visit(octree, child, range);
            }
        }
    }
}

/// Collects the triangles of all leaves below a node, with repetitions.
fn gather(octree: &Octree, node: u32, into: &mut Vec<u32>) {
    match octree.nodes[node as usize] {
        OctreeNode::Leaf(..) => into.extend_from_slice(octree.list(node)),
        OctreeNode::Inner(first) => (first..first + 8).for_each(|child| gather(octree, child, into)),
    }
}
