//! Compact form of the octree for rays that the host traces alone: the same cells in the same order as `traverse.rs`,
//! found with less work.
//!
//! - Each child is a word, and a cell's eight words are adjacent: whether a child is split, empty or a leaf is known
//!   before its data are read.
//! - Cells behind the origin are skipped: the first child is the one that contains the ray at t = max(entry, 0). Along
//!   each axis this child is in the upper half if the middle plane lies before that t, as stepping from the entry would
//!   find.
//! - A stack replaces recursion: it holds cells that have children left to visit; a cell whose last child is entered is
//!   not pushed.
//!
//! The reference's functions compute the parameters, so both traversals enter the same cells at the same parameters.

use glam::DVec3;

use super::traverse::{earliest, is_too_far, latest, middle, root_planes};
use super::{Flow, MAX_DEPTH, Octree, OctreeNode, TraversalCounts};
use crate::geom::Ray;

/// Word of a leaf without triangles.
const EMPTY: u32 = u32::MAX;
/// Bit of a leaf's word; the other bits are the leaf's number as given by the owner. A word without this bit is the
/// index of a split cell's children.
const LEAF: u32 = 1 << 31;

/// Words of an octree's cells.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Compact {
    corner: DVec3,
    size: f64,
    margin: f64,
    root: u32,
    children: Vec<[u32; 8]>,
}

#[derive(Clone, Copy, Default)]
struct WaitingCell {
    /// Parameters at which the ray meets the cell's upper planes.
    high: Keys,
    /// Parameters at which it meets the middle planes.
    middle: Keys,
    /// Index of the children.
    children: u32,
    /// Next child to visit.
    child: u32,
    /// Number of splits above the cell.
    level: u32,
}

/// Traversal stack. Its initial contents do not matter, so one stack serves many rays.
#[derive(Clone, Copy, Default)]
pub(crate) struct Waiting([WaitingCell; MAX_DEPTH as usize + 1]);

/// Parameters as the bits of f64: this keeps the order of non-negative numbers, and negative numbers come before them.
/// Comparisons and selections then run on the integer units, in one clock.
type Keys = [i64; 3];

impl Compact {
    /// Builds the words of an octree; `leaf` returns the number of a leaf with these triangles, below 2^31 - 1.
    pub(crate) fn new(octree: &Octree, mut leaf: impl FnMut(&[u32]) -> u32) -> Self {
        let mut places = vec![0; octree.nodes.len()];
        let mut cut = 0;
        for (place, node) in places.iter_mut().zip(&octree.nodes) {
            *place = match node {
                OctreeNode::Inner(_) => {
                    cut += 1;
                    cut - 1
                }
                OctreeNode::Leaf(_, 0) => EMPTY,
                OctreeNode::Leaf(first, count) => {
                    LEAF | leaf(&octree.triangles[*first as usize..(*first + *count) as usize])
                }
            };
        }
        let children = octree.nodes.iter().filter_map(|node| match node {
            OctreeNode::Inner(first) => Some(std::array::from_fn(|i| places[*first as usize + i])),
            OctreeNode::Leaf(..) => None,
        });
        let Octree { corner, size, margin, .. } = *octree;
        Self { corner, size, margin, root: places[0], children: children.collect() }
    }

    /// Calls `visit` with the number of every leaf with triangles that the ray crosses at t >= 0, and with the
    /// parameters of its entry and exit, front to back, until it returns [`Flow::Stop`].
    #[inline(always)]
    pub(crate) fn walk(
        &self,
        ray: &Ray,
        waiting: &mut Waiting,
        mut visit: impl FnMut(u32, [f64; 2]) -> Flow,
    ) -> TraversalCounts {
        if is_too_far(self.corner, self.margin, ray) {
            return self.all_leaves(visit);
        }
        let mut counts = TraversalCounts::default();
        let ([low, high], mirror) = root_planes(self.corner, self.size, ray);
        let (enter, leave) = (latest(low), earliest(high));
        if enter > leave || leave < 0.0 {
            return counts;
        }
        counts.cells = 1;
        if self.root & LEAF != 0 {
            counts.leaves = 1;
            if self.root != EMPTY {
                visit(self.root & !LEAF, [enter, leave]);
            }
            return counts;
        }
        let span = [high[0] - low[0], high[1] - low[1], high[2] - low[2]];
        let waiting = &mut waiting.0;
        let mut depth = 0;
        // Parameter of the ray's current position.
        let mut now = key(if enter > 0.0 { enter } else { 0.0 });
        let (mut frame, mut far) = WaitingCell::enter(self.root, high.map(key), span, 0, now);
        loop {
            let (exit, axis) = first(far);
            // `& 7` changes nothing: it lets the compiler drop the bounds check.
            let word = self.children[frame.children as usize][((frame.child ^ mirror) & 7) as usize];
            // In the lower half of the axis, the ray goes to the upper half; in the upper half, it leaves the cell.
            let last = frame.child & axis != 0;
            frame.child |= axis;
            counts.cells += 1;
            if word & LEAF == 0 {
                if !last {
                    waiting[depth] = frame;
                    depth += 1;
                }
                (frame, far) = WaitingCell::enter(word, far, span, frame.level + 1, now);
                continue;
            }
            counts.leaves += 1;
            if word != EMPTY && visit(word & !LEAF, [parameter(now), parameter(exit)]) == Flow::Stop {
                return counts;
            }
            now = exit;
            if last {
                if depth == 0 {
                    return counts;
                }
                depth -= 1;
                frame = waiting[depth];
            }
            far = frame.far();
        }
    }

    /// Visits all leaves with triangles, as the reference does for a ray from too far away.
    fn all_leaves(&self, mut visit: impl FnMut(u32, [f64; 2]) -> Flow) -> TraversalCounts {
        let mut counts = TraversalCounts::default();
        let words = self.children.iter().flatten().chain([&self.root]);
        for word in words.filter(|word| **word & LEAF != 0 && **word != EMPTY) {
            (counts.cells, counts.leaves) = (counts.cells + 1, counts.leaves + 1);
            if visit(word & !LEAF, [f64::NEG_INFINITY; 2]) == Flow::Stop {
                break;
            }
        }
        counts
    }
}

impl WaitingCell {
    /// Enters a cell that contains the ray at `now`; returns it and the exit parameters of the child that contains the
    /// ray.
    #[inline(always)]
    fn enter(children: u32, high: Keys, span: [f64; 3], level: u32, now: i64) -> (Self, Keys) {
        let middle = middle(high.map(parameter), span, level).map(key);
        let child = (u32::from(middle[0] < now) << 2) | (u32::from(middle[1] < now) << 1) | u32::from(middle[2] < now);
        let frame = Self { high, middle, children, child, level };
        (frame, frame.far())
    }

    /// Parameters at which the ray leaves the slabs of the next child.
    #[inline(always)]
    fn far(&self) -> Keys {
        [
            if self.child & 4 != 0 { self.high[0] } else { self.middle[0] },
            if self.child & 2 != 0 { self.high[1] } else { self.middle[1] },
            if self.child & 1 != 0 { self.high[2] } else { self.middle[2] },
        ]
    }
}

#[inline(always)]
fn key(parameter: f64) -> i64 {
    parameter.to_bits().cast_signed()
}

#[inline(always)]
fn parameter(key: i64) -> f64 {
    f64::from_bits(key.cast_unsigned())
}

/// Smallest of three parameters, and the bit of its axis; on ties, the first axis.
#[inline(always)]
fn first(far: Keys) -> (i64, u32) {
    let (x_or_y, bit) = if far[0] <= far[1] { (far[0], 4) } else { (far[1], 2) };
    if x_or_y <= far[2] { (x_or_y, bit) } else { (far[2], 1) }
}
