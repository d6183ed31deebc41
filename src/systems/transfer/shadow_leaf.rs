//! Intersection of the triangles of a leaf with a packet of rays from one point.
//!
//! The edges of a triangle span three planes with the rays' origin, and a ray hits the triangle if it runs on the inner
//! side of each. The side is the sign of a sum of products in f32; a sum below the bound of its own error and of that
//! of the caster's test is inconclusive. Planes are computed for all triangles at once, then tested with all rays of a
//! packet.
//!
//! **The bound.** Corners a, b, c and the origin are exact in f32, scaled by a power of two; a' = a - o and b - a are
//! rounded once. With R the largest magnitude of a', b', c', L that of the edges, and a direction of length 1, the sum
//! `(a' x (b - a)) . d` has products of magnitude at most R L, each with at most 7 roundings, and so an error of less
//! than 14 R L u (u = 2^-24). `triangle_test.rs` computes the same sums with as many roundings. [`BOUND`] is 32 u:
//! where all three sums exceed it both tests agree, and where one of them falls below its negative both find no hit.
//! The height of the origin over the triangle's plane is tested likewise against 32 L^2 u times the distance of the
//! nearest corner, and the ray's direction away from that plane against 32 L^2 u: so no ray that leaves a surface is
//! blocked by the triangles around its vertex.

use glam::DVec3;

use super::packets::{LANES, Packet, dot, mask, max, min, sub};
use crate::geom::vector::narrow;

/// Bound of the error of a plane's sum, in units of R L.
const BOUND: f32 = 32.0 * f32::EPSILON / 2.0;
/// Added to bounds, so that underflow is inconclusive. Lengths are relative to the mesh's extent.
const TINY: f32 = 1e-30;
/// Largest number of triangles in a leaf.
pub(super) const WIDTH: usize = 8;

/// One number per triangle of a leaf.
type Each = [f32; WIDTH];

/// The triangles of a leaf, by corner and component.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(super) struct ShadowLeaf {
    corners: [[Each; 3]; 3],
    /// Length of the longest edge.
    longest: Each,
    count: usize,
}

/// State of the rays of a packet during traversal.
pub(super) struct PacketState {
    /// Rays that nothing blocks yet.
    pub(super) live: [u32; LANES],
    /// Rays for which the test of a triangle was inconclusive.
    pub(super) unclear: [u32; LANES],
}

impl ShadowLeaf {
    /// A leaf with at most [`WIDTH`] triangles, scaled. Triangles that are points are left out, since no ray hits them.
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

    /// Tests all triangles; true if one of them blocks a live ray.
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

    /// The planes of all triangles, relative to an origin.
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
            // The height over the nearest corner has the least error.
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

/// Planes through the origin and the edges of each triangle, with normals inwards, and the triangle's own plane with
/// the normal away from the origin.
struct LeafPlanes {
    planes: [[Each; 3]; 4],
    /// The magnitude above which the sign of a sum is certain.
    bound: Each,
    /// The same for the triangle's own plane.
    front: Each,
    /// All bits set for a triangle whose plane contains the origin, within the error.
    flat: [u32; WIDTH],
}

impl LeafPlanes {
    /// All bits set for triangles that no ray of the packet hits, because the whole packet is outside of a plane.
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
    /// Tests the rays of a packet with triangle `k` of a leaf; true if it blocks a live ray.
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
