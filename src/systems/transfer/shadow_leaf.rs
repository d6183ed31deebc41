//! The triangles of a leaf against a packet of rays from one point.
//!
//! A triangle is three planes through the rays' origin, and a ray goes through it if it runs on the inner side of each.
//! The side is the sign of a sum of products in f32; a sum below a bound of its error, and of the error of the test
//! that a caster makes, says nothing. Planes are found for all triangles at once, and then held against all rays of a
//! packet.
//!
//! **The bound.** Corners a, b, c and the origin are exact in f32, scaled by a power of two; a' = a - o and b - a are
//! rounded once. With R the largest magnitude of a', b', c', L that of the edges, and a direction of length 1, the sum
//! `(a' x (b - a)) . d` has products of magnitude at most R L, each of at most 7 roundings, and so is off by less than
//! 14 R L u (u = 2^-24). `triangle_test.rs` computes the same figures with as many roundings. [`BOUND`] is 32 u: where
//! all three sums exceed it both tests agree, and where one of them falls below it both see no hit there. The height of
//! the origin over the triangle's plane is judged likewise by 32 L^2 u times the distance of the nearest corner, and
//! whether a ray runs away from that plane by 32 L^2 u: so no ray that leaves a surface is stopped by the triangles
//! around its vertex.

use glam::DVec3;

use super::packets::{LANES, Packet, dot, mask, max, min, sub};
use crate::geom::vector::narrow;

/// The largest error of a plane's sum, in R L.
const BOUND: f32 = 32.0 * f32::EPSILON / 2.0;
/// What is added to bounds, so that what underflows is not certain. Lengths are shares of the mesh's extent.
const TINY: f32 = 1e-30;
/// Triangles of a leaf at most.
pub(super) const WIDTH: usize = 8;

/// A number per triangle of a leaf.
type Each = [f32; WIDTH];

/// The triangles of a leaf, by corner and component.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(super) struct ShadowLeaf {
    corners: [[Each; 3]; 3],
    /// The largest length of an edge.
    longest: Each,
    count: usize,
}

/// The rays of a packet on their way.
pub(super) struct PacketState {
    /// Those that nothing blocks yet.
    pub(super) live: [u32; LANES],
    /// Those that a triangle neither certainly blocks nor certainly misses.
    pub(super) unclear: [u32; LANES],
}

impl ShadowLeaf {
    /// Of at most [`WIDTH`] triangles, brought to a scale. Those that are points are left out: nothing hits them.
    pub(super) fn new(triangles: &[[DVec3; 3]], scale: f64) -> Self {
        let mut leaf = Self { corners: [[[0.0; WIDTH]; 3]; 3], longest: [0.0; WIDTH], count: 0 };
        for triangle in triangles {
            let corners = triangle.map(|corner| narrow(scale * corner));
            let [a, b, c] = corners;
            if a == b && b == c {
                continue;
            }
            for (into, corner) in leaf.corners.iter_mut().zip(corners) {
                (0..3).for_each(|axis| into[axis][leaf.count] = corner[axis]);
            }
            let lengths = [sub(b, a), sub(c, b), sub(a, c)].map(|edge| dot(edge, edge).sqrt());
            leaf.longest[leaf.count] = lengths.into_iter().fold(0.0, f32::max);
            leaf.count += 1;
        }
        leaf
    }

    /// Whether one of the triangles blocks a live ray.
    #[inline(always)]
    pub(super) fn test(&self, origin: [f32; 3], packet: &Packet, state: &mut PacketState) -> bool {
        let planes = self.planes(origin);
        let passed = planes.passed(packet);
        let mut blocks = false;
        for k in 0..self.count {
            if passed[k] == 0 {
                blocks |= state.judge(&planes, k, packet);
            }
        }
        blocks
    }

    /// The planes of all triangles.
    #[inline(always)]
    fn planes(&self, origin: [f32; 3]) -> LeafPlanes {
        let mut from = [[[0.0; WIDTH]; 3]; 3];
        for corner in 0..3 {
            for axis in 0..3 {
                for k in 0..WIDTH {
                    from[corner][axis][k] = self.corners[corner][axis][k] - origin[axis];
                }
            }
        }
        let edge = |from: usize, to: usize| {
            let mut edge = [[0.0; WIDTH]; 3];
            for axis in 0..3 {
                for k in 0..WIDTH {
                    edge[axis][k] = self.corners[to][axis][k] - self.corners[from][axis][k];
                }
            }
            edge
        };
        let (ab, bc, ca) = (edge(0, 1), edge(1, 2), edge(2, 0));
        let normal = crosses(&ca, &ab);
        let heights = [dots(&normal, &from[0]), dots(&normal, &from[1]), dots(&normal, &from[2])];
        let mut planes = [crosses(&from[0], &ab), crosses(&from[1], &bc), crosses(&from[2], &ca), normal];
        let squares = [dots(&from[0], &from[0]), dots(&from[1], &from[1]), dots(&from[2], &from[2])];
        let (mut height, mut bound, mut front, mut flat) = ([0.0; WIDTH], [0.0; WIDTH], [0.0; WIDTH], [0; WIDTH]);
        for k in 0..WIDTH {
            let reach = max(max(squares[0][k], squares[1][k]), squares[2][k]).sqrt();
            bound[k] = BOUND * reach * self.longest[k] + TINY;
            front[k] = BOUND * self.longest[k] * self.longest[k] + TINY;
            // The nearest corner has the height with the least error.
            let (mut nearest, mut least) = (heights[0][k], squares[0][k]);
            for corner in 1..3 {
                nearest = if squares[corner][k] < least { heights[corner][k] } else { nearest };
                least = min(least, squares[corner][k]);
            }
            height[k] = nearest;
            flat[k] = mask(nearest.abs() <= front[k] * least.sqrt() + TINY);
        }
        for plane in &mut planes {
            for axis in 0..3 {
                for k in 0..WIDTH {
                    plane[axis][k] = if height[k] < 0.0 { -plane[axis][k] } else { plane[axis][k] };
                }
            }
        }
        LeafPlanes { planes, bound, front, flat }
    }
}

/// Planes of triangles through one point, their normals inwards, and their own planes with normals away from the point.
struct LeafPlanes {
    planes: [[Each; 3]; 4],
    /// What a sum must exceed to be certain.
    bound: Each,
    /// The same for the triangle's own plane.
    front: Each,
    /// All bits of a triangle whose plane holds the point, as far as that can be told.
    flat: [u32; WIDTH],
}

impl LeafPlanes {
    /// All bits of the triangles that no ray of a packet goes through: the packet lies on the outer side of a plane.
    #[inline(always)]
    fn passed(&self, packet: &Packet) -> [u32; WIDTH] {
        let [mx, my, mz] = packet.middle;
        let mut passed = [0; WIDTH];
        for (plane, bound) in self.planes.iter().zip([&self.bound, &self.bound, &self.bound, &self.front]) {
            for k in 0..WIDTH {
                let (x, y, z) = (plane[0][k], plane[1][k], plane[2][k]);
                let along = x * mx + y * my + z * mz;
                let size = (x * x + y * y + z * z).sqrt();
                passed[k] |= mask(along + size * packet.radius < -2.0 * bound[k]) & !self.flat[k];
            }
        }
        passed
    }
}

impl PacketState {
    /// Holds the rays of a packet against triangle `k` of a leaf; whether it blocks a live one.
    #[inline(always)]
    fn judge(&mut self, leaf: &LeafPlanes, k: usize, packet: &Packet) -> bool {
        let [ab, bc, ca, own] = &leaf.planes;
        let (bound, front, flat) = (leaf.bound[k], leaf.front[k], leaf.flat[k]);
        let [x, y, z] = &packet.direction;
        let (mut hits, mut any) = ([0; LANES], 0);
        for i in 0..LANES {
            let along = |plane: &[Each; 3]| plane[0][k] * x[i] + plane[1][k] * y[i] + plane[2][k] * z[i];
            let (one, two, three) = (along(ab), along(bc), along(ca));
            let least = min(min(one, two), three);
            let most = max(max(one, two), three);
            let beside = mask(least < -bound) & (!flat | mask(most > bound));
            let outside = beside | mask(along(own) < -front) & !flat;
            let hit = mask(least > bound) & !flat & self.live[i];
            self.unclear[i] |= !hit & !outside;
            hits[i] = hit;
            any |= hit;
        }
        for i in 0..LANES {
            self.live[i] &= !hits[i];
        }
        any != 0
    }
}

#[inline(always)]
fn crosses(one: &[Each; 3], other: &[Each; 3]) -> [Each; 3] {
    let mut cross = [[0.0; WIDTH]; 3];
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        for k in 0..WIDTH {
            cross[axis][k] = one[u][k] * other[v][k] - one[v][k] * other[u][k];
        }
    }
    cross
}

#[inline(always)]
fn dots(one: &[Each; 3], other: &[Each; 3]) -> Each {
    let mut dot = [0.0; WIDTH];
    for k in 0..WIDTH {
        dot[k] = one[0][k] * other[0][k] + one[1][k] * other[1][k] + one[2][k] * other[2][k];
    }
    dot
}
