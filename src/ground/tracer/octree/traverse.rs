//! The parametric traversal in its plain form: the reference for `compact.rs`, and the traversal that the Ray Engine
//! uses.

use std::ops::ControlFlow;

use glam::DVec3;

use super::cells::{CellId, GpuCells};
use super::{Octree, OctreeNode};
use crate::geom::Ray;

/// Substitute for a zero component of a direction: f64 can represent the parameter of a plane at the scene's size, and
/// the mean of two such parameters still shows which half of a cell the ray is in.
const TINY_COMPONENT: f64 = 1e-200;

/// Maximum distance of a ray's origin, in margins. The parameter of a plane is a difference and a quotient, each
/// rounded to 53 bits; each level adds a difference of such parameters.
const MAX_DISTANCE: f64 = (1u64 << 48) as f64;

/// Traversal control after a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flow {
    /// Continue to the next cell.
    Continue,
    /// End the traversal.
    Stop,
}

/// Counters of traversal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TraversalCounts {
    /// Number of cells entered, including the root and split cells.
    pub cells: u64,
    /// Number of leaves entered.
    pub leaves: u64,
}

impl std::ops::AddAssign for TraversalCounts {
    fn add_assign(&mut self, other: Self) {
        self.cells += other.cells;
        self.leaves += other.leaves;
    }
}

/// Cell crossed by a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Visit<'a> {
    /// The cell.
    pub cell: CellId,
    /// Triangles of the cell, in ascending order.
    pub triangles: &'a [u32],
    /// `true` if the cell is a GPU cell, whose triangles are sent to the card together.
    pub gpu: bool,
    /// Parameters at which the ray enters and leaves the cell, in multiples of the ray's direction. The entry may lie
    /// behind the origin.
    pub t: [f64; 2],
}

/// Parameters at which a ray meets the lower and the upper planes of a cell, after mirroring it so that its direction
/// is positive.
pub(super) type Planes = [[f64; 3]; 2];

struct Walk<'a, F> {
    octree: &'a Octree,
    gpu: Option<&'a GpuCells>,
    /// Cells that the ray leaves at or before this parameter are skipped.
    from: f64,
    /// Bits of child numbers flipped by mirroring.
    mirror: u32,
    /// Differences of the parameters of the root's upper and lower planes.
    span: [f64; 3],
    counts: TraversalCounts,
    visit: F,
}

impl Octree {
    /// Calls `visit` for every cell with triangles that the ray crosses at t >= 0, front to back, until it returns
    /// [`Flow::Stop`]. With `gpu`, each GPU cell is visited as a whole; otherwise all visited cells are leaves.
    pub fn traverse<'a>(
        &'a self,
        ray: &Ray,
        gpu: Option<&'a GpuCells>,
        visit: impl FnMut(&Visit<'a>) -> Flow,
    ) -> TraversalCounts {
        self.traverse_from(ray, gpu, f64::NEG_INFINITY, visit)
    }

    /// Like [`Self::traverse`], for a ray that has left a cell at `from`, in multiples of its direction: skips cells
    /// that it has left by then.
    pub fn traverse_from<'a>(
        &'a self,
        ray: &Ray,
        gpu: Option<&'a GpuCells>,
        from: f64,
        visit: impl FnMut(&Visit<'a>) -> Flow,
    ) -> TraversalCounts {
        if self.is_too_far(ray) {
            return self.all_leaves(visit);
        }
        let ([low, high], mirror) = root_planes(self.corner, self.size, ray);
        let span = [0, 1, 2].map(|i| high[i] - low[i]);
        let mut walk = Walk { octree: self, gpu, from, mirror, span, counts: TraversalCounts::default(), visit };
        if latest(low) <= earliest(high) {
            // It does not matter here whether the traversal was stopped or ran out of cells.
            let _: ControlFlow<()> = walk.enter(0, 0, [low, high]);
        }
        walk.counts
    }

    /// Returns `true` if a ray starts so far away that f64 cannot resolve the parameters of the cells' planes to within
    /// the margins.
    pub(super) fn is_too_far(&self, ray: &Ray) -> bool {
        is_too_far(self.corner, self.margin, ray)
    }

    /// Visits all leaves, for a ray whose crossings cannot be computed. No hit excludes the other leaves, so each has t
    /// of minus infinity. GPU cells are not visited, because a ray could not continue behind one.
    fn all_leaves<'a>(&'a self, mut visit: impl FnMut(&Visit<'a>) -> Flow) -> TraversalCounts {
        let mut counts = TraversalCounts::default();
        for node in 0..self.nodes.len() as u32 {
            let (triangles, t) = (self.list(node), [f64::NEG_INFINITY; 2]);
            if triangles.is_empty() {
                continue;
            }
            (counts.cells, counts.leaves) = (counts.cells + 1, counts.leaves + 1);
            if visit(&Visit { cell: CellId(node), triangles, gpu: false, t }) == Flow::Stop {
                break;
            }
        }
        counts
    }
}

/// Returns `true` if a ray starts too far from the corner of an octree with this margin.
#[inline(always)]
pub(super) fn is_too_far(corner: DVec3, margin: f64, ray: &Ray) -> bool {
    let far = |axis: usize| (f64::from(ray.origin()[axis]) - corner[axis]).abs() > margin * MAX_DISTANCE;
    far(0) | far(1) | far(2)
}

/// Parameters at which the ray, mirrored so that its direction is positive, meets the planes of a cube, and the bits of
/// a child's number that mirroring flips.
#[inline(always)]
pub(super) fn root_planes(corner: DVec3, size: f64, ray: &Ray) -> (Planes, u32) {
    let (mut low, mut high, mut mirror) = ([0.0; 3], [0.0; 3], 0);
    for axis in 0..3 {
        let (mut origin, mut speed) = (f64::from(ray.origin()[axis]), f64::from(ray.direction()[axis]));
        let (near, far) = (corner[axis], corner[axis] + size);
        if speed < 0.0 {
            (origin, speed) = (near + far - origin, -speed);
            mirror |= 4 >> axis;
        }
        // Includes -0.
        if speed == 0.0 {
            speed = TINY_COMPONENT;
        }
        low[axis] = (near - origin) / speed;
        high[axis] = (far - origin) / speed;
    }
    ([low, high], mirror)
}

#[inline(always)]
pub(super) fn latest(t: [f64; 3]) -> f64 {
    t[0].max(t[1]).max(t[2])
}

#[inline(always)]
pub(super) fn earliest(t: [f64; 3]) -> f64 {
    t[0].min(t[1]).min(t[2])
}

impl<'a, F: FnMut(&Visit<'a>) -> Flow> Walk<'a, F> {
    /// Enters a cell with `level` splits above it.
    fn enter(&mut self, node: u32, level: u32, [low, high]: Planes) -> ControlFlow<()> {
        let leave = earliest(high);
        if leave < 0.0 || leave <= self.from {
            return ControlFlow::Continue(());
        }
        self.counts.cells += 1;
        let visit = |triangles, gpu| Visit { cell: CellId(node), triangles, gpu, t: [latest(low), leave] };
        if let Some(triangles) = self.gpu.and_then(|gpu| gpu.triangles(CellId(node))) {
            return flow((self.visit)(&visit(triangles, true)));
        }
        match self.octree.nodes[node as usize] {
            OctreeNode::Leaf(_, count) => {
                self.counts.leaves += 1;
                if count == 0 {
                    ControlFlow::Continue(())
                } else {
                    flow((self.visit)(&visit(self.octree.list(node), false)))
                }
            }
            OctreeNode::Inner(first) => self.children(first, level, [low, high]),
        }
    }

    /// Visits the children that the ray crosses, front to back.
    fn children(&mut self, first: u32, level: u32, [low, high]: Planes) -> ControlFlow<()> {
        let middle = middle(high, self.span, level);
        let mut child = first_child(low, middle);
        loop {
            let half = |axis: usize| if child >> (2 - axis) & 1 == 1 { (middle, high) } else { (low, middle) };
            let (mut near, mut far) = ([0.0; 3], [0.0; 3]);
            for axis in 0..3 {
                let (from, to) = half(axis);
                (near[axis], far[axis]) = (from[axis], to[axis]);
            }
            self.enter(first + (child ^ self.mirror), level + 1, [near, far])?;
            // The ray leaves through the nearest plane; from an upper half, it leaves the parent.
            let axis = first_axis(far);
            let bit = 4 >> axis;
            if child & bit != 0 {
                return ControlFlow::Continue(());
            }
            child |= bit;
        }
    }
}

/// Parameters of the middle planes of a cell with `level` splits above it: the upper planes' parameters minus half of
/// the cell's fraction of the root's span. The fraction is a power of two, so only the difference is rounded.
#[inline(always)]
pub(super) fn middle(high: [f64; 3], span: [f64; 3], level: u32) -> [f64; 3] {
    // 2^-(level + 1), built from its exponent bits.
    let half = f64::from_bits(u64::from(1022 - level) << 52);
    [high[0] - half * span[0], high[1] - half * span[1], high[2] - half * span[2]]
}

fn flow(flow: Flow) -> ControlFlow<()> {
    match flow {
        Flow::Continue => ControlFlow::Continue(()),
        Flow::Stop => ControlFlow::Break(()),
    }
}

/// Child that the ray enters first: along each axis, the upper half if its middle plane lies before the entry.
fn first_child(low: [f64; 3], middle: [f64; 3]) -> u32 {
    let entry = latest(low);
    (0..3).filter(|&axis| middle[axis] < entry).map(|axis| 4 >> axis).sum()
}

fn first_axis(far: [f64; 3]) -> usize {
    if far[0] <= far[1] {
        if far[0] <= far[2] { 0 } else { 2 }
    } else if far[1] <= far[2] {
        1
    } else {
        2
    }
}
