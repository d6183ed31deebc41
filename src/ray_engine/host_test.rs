//! The host's own ray-triangle test: `float.psa` and `seven_vectors.vsa` in f32, operation by operation.
//!
//! Whether a ray meets a triangle on the card or on the host is a matter of scheduling and must not show in the
//! result; so the host computes what a card with fp32 pipelines computes, bit for bit (tests draw both): with the
//! scene brought to the same scale, so that lengths of any unit neither overflow nor vanish. Every `f32` operation
//! here is one IEEE operation with its own rounding: Rust never fuses them.

use super::rays::normalise_range;
use crate::geom::exact::Sides;
use crate::geom::{Mesh, Ray};

type Vector = [f32; 3];

/// A triangle as the vertex program hands it on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct HostTriangle {
    a: Vector,
    b: Vector,
    n: Vector,
    ab: Vector,
    ac: Vector,
    bc: Vector,
}

/// A ray as the textures hold it: its direction brought into range by a power of two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct HostRay {
    pub(super) origin: Vector,
    pub(super) direction: Vector,
    /// What a t in scaled units along `direction` is multiplied by for the ray's own direction; a power of two.
    pub(crate) power: f64,
}

impl HostTriangle {
    /// All triangles of a mesh, at a scale.
    pub(crate) fn all(mesh: &Mesh, scale: f64) -> Vec<Self> {
        mesh.iter_corners().map(|corners| Self::new(scaled_corners(corners, scale))).collect()
    }

    #[inline(always)]
    pub(super) fn new([a, b, c]: [Vector; 3]) -> Self {
        let (ab, ac, bc) = (sub(b, a), sub(c, a), sub(c, b));
        Self { a, b, n: cross(ab, ac), ab, ac, bc }
    }

    /// The t of a hit along the ray's direction in range: not behind the origin, inside or on the edges, and from the front
    /// unless `sides` says either.
    pub(crate) fn hit(&self, ray: &HostRay, sides: Sides) -> Option<f32> {
        let (t, hit) = match sides {
            Sides::Front => self.test::<false>(ray),
            Sides::Both => self.test::<true>(ray),
        };
        hit.then_some(t)
    }

    /// t, and whether there is a hit there. Without branches: packets run it on lanes.
    #[inline(always)]
    pub(super) fn test<const BOTH: bool>(&self, ray: &HostRay) -> (f32, bool) {
        let (ao, bo) = (sub(ray.origin, self.a), sub(ray.origin, self.b)); // (1), (2)
        let n_dot_d = dot(self.n, ray.direction);
        let t = dot(self.n, ao) * -n_dot_d.recip(); // (3)
        let (aod, bod) = (cross(ao, ray.direction), cross(bo, ray.direction)); // (4), (5)
        let inside = [dot(self.ac, aod), dot(neg(self.ab), aod), dot(neg(self.bc), bod)]; // (6), (7), (8)
        let (faces, inside) = if BOTH {
            (n_dot_d != 0.0, inside.map(|x| if n_dot_d >= 0.0 { -x } else { x }))
        } else {
            (n_dot_d < 0.0, inside)
        };
        let killed = (inside[0] < 0.0) | (inside[1] < 0.0) | (inside[2] < 0.0);
        (t, faces & !killed & (t >= 0.0))
    }
}

impl HostRay {
    /// A ray among triangles at a scale.
    pub(crate) fn new(ray: &Ray, scale: f64) -> Self {
        let (direction, power) = normalise_range(ray.direction());
        Self { origin: scaled(ray.origin(), scale), direction: direction.map(|x| x as f32), power: power / scale }
    }
}

/// A point times a power of two: exact unless it leaves the range of single precision.
#[inline(always)]
pub(super) fn scaled(p: Vector, scale: f64) -> Vector {
    p.map(|x| (f64::from(x) * scale) as f32)
}

/// Three of them.
pub(super) fn scaled_corners(corners: [Vector; 3], scale: f64) -> [Vector; 3] {
    corners.map(|p| scaled(p, scale))
}

#[inline(always)]
pub(super) fn sub(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
pub(super) fn neg(a: Vector) -> Vector {
    a.map(|x| -x)
}

/// Sums from the left, as `dp3` of the fp32 profiles.
#[inline(always)]
pub(super) fn dot(a: Vector, b: Vector) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The first product is rounded, then the second, then their difference, as `mul` and `mad`, or `crs`, of the fp32 profiles.
#[inline(always)]
pub(super) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
