//! The ray-triangle test in f32: the computation of the Ray Engine's `float.psa` and `seven_vectors.vsa`, operation by
//! operation.
//!
//! Scheduling decides whether a ray is tested on the card or on the host, and must not affect the result. So the host
//! computes bit for bit the result of a card with fp32 pipelines (tests compare both). Host and card scale the scene
//! alike, so that lengths of any unit neither overflow nor vanish. Every `f32` operation here is one IEEE operation
//! with its own rounding: neither Rust nor glam fuses operations, and glam's sums of three products run from the left,
//! as `dp3` does in the fp32 profiles.

use glam::Vec3;

use super::scale::normalize_range;
use crate::geom::exact::Sides;
use crate::geom::vector::wide;
use crate::geom::{Mesh, Ray};

/// Triangle as output by the vertex program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HostTriangle {
    a: Vec3,
    b: Vec3,
    n: Vec3,
    ab: Vec3,
    ac: Vec3,
    bc: Vec3,
}

/// Ray as stored in the textures, with the direction scaled into range by a power of two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HostRay {
    /// Origin in scaled units.
    pub origin: Vec3,
    /// Direction, its largest component in [1/2, 1).
    pub direction: Vec3,
    /// Factor from t in scaled units along `direction` to t of the ray's own direction; a power of two.
    pub power: f64,
}

impl HostTriangle {
    /// Converts all triangles of a mesh, at a scale.
    pub fn all(mesh: &Mesh, scale: f64) -> Vec<Self> {
        mesh.iter_corners().map(|corners| Self::new(scaled_corners(corners, scale))).collect()
    }

    /// Triangle with these corners in scaled units.
    #[inline(always)]
    pub fn new([a, b, c]: [Vec3; 3]) -> Self {
        let (ab, ac, bc) = (b - a, c - a, c - b);
        Self { a, b, n: ab.cross(ac), ab, ac, bc }
    }

    /// Returns t of a hit along the scaled direction. A hit has t >= 0, lies inside the triangle or on its edges, and
    /// is on the front side unless `sides` includes the back.
    pub fn hit(&self, ray: &HostRay, sides: Sides) -> Option<f32> {
        let (t, hit) = match sides {
            Sides::Front => self.test::<false>(ray),
            Sides::Both => self.test::<true>(ray),
        };
        hit.then_some(t)
    }

    /// Returns t, and `true` if it is a hit. Branch-free, because packets run the same test on lanes.
    #[inline(always)]
    pub fn test<const BOTH: bool>(&self, ray: &HostRay) -> (f32, bool) {
        let (ao, bo) = (ray.origin - self.a, ray.origin - self.b); // (1), (2)
        let n_dot_d = self.n.dot(ray.direction);
        let t = self.n.dot(ao) * -n_dot_d.recip(); // (3)
        let (aod, bod) = (ao.cross(ray.direction), bo.cross(ray.direction)); // (4), (5)
        let inside = [self.ac.dot(aod), (-self.ab).dot(aod), (-self.bc).dot(bod)]; // (6), (7), (8)
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
    /// Converts a ray at the scale of the triangles.
    pub fn new(ray: &Ray, scale: f64) -> Self {
        let (direction, power) = normalize_range(ray.direction());
        Self { origin: scaled(ray.origin(), scale), direction: direction.as_vec3(), power: power / scale }
    }
}

/// Multiplies a point by a power of two: exact unless it leaves the range of single precision.
#[inline(always)]
pub fn scaled(p: [f32; 3], scale: f64) -> Vec3 {
    (wide(p) * scale).as_vec3()
}

/// Applies [`scaled`] to the corners of a triangle.
pub fn scaled_corners(corners: [[f32; 3]; 3], scale: f64) -> [Vec3; 3] {
    corners.map(|p| scaled(p, scale))
}
