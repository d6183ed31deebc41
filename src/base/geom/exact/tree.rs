//! A tree of boxes over a mesh that never skips a hit, for many rays.
//!
//! A box encloses its triangles exactly, because f64 holds every f32. A ray crosses the plane x = k at t = (k - o) / d,
//! computed with at most three roundings; the interval of t inside a box is widened by 16 u at both ends, so that it
//! contains the exact interval (no operation can overflow or underflow: see [`super::filter`]). A box is skipped only
//! if its widened interval is empty, or begins beyond the upper bound of t of a certain hit. So the tree affects the
//! time, but not the result.

use std::borrow::Cow;

use glam::DVec3;
use rayon::prelude::*;

use super::{NearestHit, Shortlist, Sides, filter};
use crate::geom::vector::wide;
use crate::geom::{Mesh, Ray};

/// Maximum number of triangles in a leaf.
const LEAF: usize = 4;

/// Rays per parallel task.
const CHUNK: usize = 256;

/// Mesh with a bounding volume hierarchy for many exact queries.
#[derive(Debug, Clone)]
pub struct Tracer<'a> {
    mesh: Cow<'a, Mesh>,
    nodes: Vec<BoxNode>,
    /// Triangle ids in the order of the leaves.
    order: Vec<u32>,
    corners: Vec<[[f32; 3]; 3]>,
}

#[derive(Debug, Clone, Copy)]
struct BoxNode {
    low: DVec3,
    high: DVec3,
    content: BoxContent,
}

#[derive(Debug, Clone, Copy)]
enum BoxContent {
    /// Leaf: a range of `order`.
    Leaf { start: u32, end: u32 },
    /// Inner node: the first child follows its parent; `second` is the index of the second child.
    Inner { second: u32 },
}

/// Ray in f64, with the values that box tests need.
struct Probe {
    origin: DVec3,
    direction: DVec3,
    inverse: DVec3,
}

impl Tracer<'static> {
    /// Builds the tree of [`Tracer::new`] and takes ownership of the mesh.
    pub fn owning(mesh: Mesh) -> Self {
        Self::over(Cow::Owned(mesh))
    }
}

impl<'a> Tracer<'a> {
    /// Builds the tree: each node is split at the median centre along its widest axis, so that its depth is bounded.
    pub fn new(mesh: &'a Mesh) -> Self {
        Self::over(Cow::Borrowed(mesh))
    }

    fn over(mesh: Cow<'a, Mesh>) -> Self {
        let corners: Vec<_> = mesh.iter_corners().collect();
        let mut items: Vec<(u32, DVec3)> =
            (0..).zip(&corners).map(|(id, triangle)| (id, triangle.iter().map(|&corner| wide(corner)).sum())).collect();
        let mut nodes = Vec::with_capacity(items.len());
        if !items.is_empty() {
            build(&mut items, 0, &corners, &mut nodes);
        }
        let order: Vec<u32> = items.iter().map(|&(id, _)| id).collect();
        let corners = order.iter().map(|&id| corners[id as usize]).collect();
        Self { mesh, nodes, order, corners }
    }

    /// Mesh of the tree.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Returns the first hit of a ray, equal to [`super::nearest`].
    pub fn nearest(&self, ray: &Ray, sides: Sides) -> Option<NearestHit> {
        let (origin, direction) = (wide(ray.origin()), wide(ray.direction()));
        let probe = Probe { origin, direction, inverse: 1.0 / direction };
        let mut shortlist = Shortlist::new();
        let mut stack: Vec<(u32, f64)> = Vec::with_capacity(64);
        if let Some(start) = self.nodes.first().and_then(|root| probe.enter(root)) {
            stack.push((0, start));
        }
        while let Some((index, start)) = stack.pop() {
            if start > shortlist.limit {
                continue;
            }
            match self.nodes[index as usize].content {
                BoxContent::Leaf { start, end } => {
                    for slot in start as usize..end as usize {
                        shortlist.try_triangle(ray, self.order[slot], &self.corners[slot], sides);
                    }
                }
                BoxContent::Inner { second } => {
                    let first = index + 1;
                    let mut found = [first, second].map(|child| (child, probe.enter(&self.nodes[child as usize])));
                    // The nearer child is pushed last, so that it is popped first.
                    if found[0].1 < found[1].1 {
                        found.swap(0, 1);
                    }
                    stack.extend(found.into_iter().filter_map(|(child, start)| Some((child, start?))));
                }
            }
        }
        shortlist.settle(&self.mesh, ray, sides)
    }

    /// Returns the first hits of many rays, in parallel; the result does not depend on the number of threads.
    pub fn nearest_all(&self, rays: &[Ray], sides: Sides) -> Vec<Option<NearestHit>> {
        rays.par_iter().with_min_len(CHUNK).map(|ray| self.nearest(ray, sides)).collect()
    }
}

/// Returns the first hits of many rays, in parallel.
pub fn nearest_all(mesh: &Mesh, rays: &[Ray], sides: Sides) -> Vec<Option<NearestHit>> {
    Tracer::new(mesh).nearest_all(rays, sides)
}

/// Builds the node of `items`, which start at `offset` in the whole order, and its subtree.
fn build(items: &mut [(u32, DVec3)], offset: usize, corners: &[[[f32; 3]; 3]], nodes: &mut Vec<BoxNode>) {
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for corner in items.iter().flat_map(|&(id, _)| corners[id as usize]).map(wide) {
        (low, high) = (low.min(corner), high.max(corner));
    }
    let place = nodes.len();
    let leaf = BoxContent::Leaf { start: offset as u32, end: (offset + items.len()) as u32 };
    nodes.push(BoxNode { low, high, content: leaf });
    if items.len() <= LEAF {
        return;
    }
    let axis = (high - low).max_position();
    let middle = items.len() / 2;
    // Ids break ties, so that the halves do not depend on the standard library's selection algorithm.
    items.select_nth_unstable_by(middle, |a, b| a.1[axis].total_cmp(&b.1[axis]).then(a.0.cmp(&b.0)));
    let (left, right) = items.split_at_mut(middle);
    build(left, offset, corners, nodes);
    let second = nodes.len() as u32;
    build(right, offset + middle, corners, nodes);
    nodes[place].content = BoxContent::Inner { second };
}

impl Probe {
    /// Returns a lower bound (at least 0) of the t at which the ray enters the box; `None` if it certainly misses.
    fn enter(&self, node: &BoxNode) -> Option<f64> {
        let (mut start, mut end) = (0.0_f64, f64::INFINITY);
        for axis in 0..3 {
            let low = node.low[axis] - self.origin[axis];
            let high = node.high[axis] - self.origin[axis];
            if self.direction[axis] == 0.0 {
                if low > 0.0 || high < 0.0 {
                    return None;
                }
                continue;
            }
            let (mut near, mut far) = (low * self.inverse[axis], high * self.inverse[axis]);
            if near > far {
                (near, far) = (far, near);
            }
            // A start below 0 does not matter, and an end below 0 means that the box lies behind the origin.
            if near > 0.0 {
                near = filter::below(near);
                start = if near > start { near } else { start };
            }
            if far < 0.0 {
                return None;
            }
            far = filter::above(far);
            end = if far < end { far } else { end };
        }
        (start <= end).then_some(start)
    }
}
