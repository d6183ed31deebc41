//! Reference solution: exit radiance of a vertex under a light of spherical harmonics, in f64, every ray tested against
//! every triangle. Section 3.1 without matrices, rotation of coefficients, compression or a card.
//!
//! It shares the BRDF and the direction rule with the code that it checks, and no other arithmetic.

use std::f64::consts::PI;

use glam::DVec3;

use crate::elementary::{atan2, sin_cos};
use crate::geom::vector::{unit, wide};
use crate::sphere::DirectionRule;
use crate::transfer::brdf::Brdf;
use crate::transfer::{LocalFrame, Vertices};

/// Distance of ray origins from the triangles at a vertex, relative to the mesh's size.
const LIFT: f64 = 1e-7;
/// The least z of a view direction at a vertex: a hit vertex whose normal faces away is seen at this height instead.
const LEAST_HEIGHT: f64 = 1e-6;

/// Input of the reference: vertices, one BRDF per material, light in global coordinates.
#[derive(Clone, Copy, Debug)]
pub struct Reference<'a> {
    /// The mesh.
    pub vertices: &'a Vertices,
    /// A BRDF per material.
    pub brdfs: &'a [Brdf],
    /// Directions over each vertex's hemisphere.
    pub rule: &'a DirectionRule,
    /// Coefficients of the light, by index l (l + 1) + m.
    pub light: &'a [f64],
}

impl Reference<'_> {
    /// The radiance that a vertex sends towards `view` in its local frame, after at most `bounces` interreflections.
    /// The time is exponential in the number of bounces: for small meshes only.
    ///
    /// # Panics
    /// If there is no such vertex, or no BRDF of a material.
    pub fn exit_radiance(&self, vertex: usize, view: DVec3, bounces: u32) -> f64 {
        let frame = &self.vertices.frames()[vertex];
        let brdf = &self.brdfs[self.vertices.materials()[vertex] as usize];
        let mut sum = 0.0;
        for (&s, weight) in self.rule.directions().iter().zip(self.rule.weights()) {
            // T_p(s, .) B(v, s) s_z ds
            sum += weight * self.incident_radiance(vertex, frame, s, bounces) * brdf.value(view, s) * s.z;
        }
        sum
    }

    /// The radiance that arrives at a vertex from a local direction.
    fn incident_radiance(&self, vertex: usize, frame: &LocalFrame, local: DVec3, bounces: u32) -> f64 {
        let direction = frame.to_global(local);
        let Some((triangle, weights)) = self.first_hit(vertex, direction) else {
            return self.light.iter().enumerate().map(|(index, l)| l * harmonic(index, direction)).sum();
        };
        let [a, b, c] = self.corners(triangle);
        if bounces == 0 || (b - a).cross(c - a).dot(direction) >= 0.0 {
            return 0.0;
        }
        let corners = self.vertices.triangles()[triangle].into_iter().zip(weights);
        corners
            .map(|(corner, weight)| {
                let local = self.vertices.frames()[corner as usize].to_local(-direction);
                let raised = local.with_z(local.z.max(LEAST_HEIGHT)).normalize();
                weight * self.exit_radiance(corner as usize, raised, bounces - 1)
            })
            .sum()
    }

    /// The first triangle along a ray from a vertex, with barycentric weights of the hit.
    fn first_hit(&self, vertex: usize, direction: DVec3) -> Option<(usize, [f64; 3])> {
        let origin = self.origin(vertex);
        let mut first: Option<(f64, usize, [f64; 3])> = None;
        for triangle in 0..self.vertices.triangles().len() {
            let [a, b, c] = self.corners(triangle);
            let (ab, ac) = (b - a, c - a);
            let across = direction.cross(ac);
            let determinant = ab.dot(across);
            if determinant == 0.0 {
                continue;
            }
            let from = origin - a;
            let u = from.dot(across) / determinant;
            let v = direction.dot(from.cross(ab)) / determinant;
            let t = ac.dot(from.cross(ab)) / determinant;
            if u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && first.is_none_or(|(nearest, ..)| t < nearest) {
                first = Some((t, triangle, [1.0 - u - v, u, v]));
            }
        }
        first.map(|(_, triangle, weights)| (triangle, weights))
    }

    /// The vertex position, moved off the triangles that meet there.
    fn origin(&self, vertex: usize) -> DVec3 {
        let place = wide(self.vertices.positions()[vertex]);
        let mut towards = DVec3::ZERO;
        let mut size: f64 = 0.0;
        for triangle in 0..self.vertices.triangles().len() {
            let [a, b, c] = self.corners(triangle);
            size = size.max(a.distance(place));
            if [a, b, c].contains(&place) {
                towards += unit((b - a).cross(c - a)).unwrap_or(DVec3::ZERO);
            }
        }
        place + LIFT * size * unit(towards).unwrap_or(DVec3::ZERO)
    }

    fn corners(&self, triangle: usize) -> [DVec3; 3] {
        self.vertices.triangles()[triangle].map(|vertex| wide(self.vertices.positions()[vertex as usize]))
    }
}

/// The harmonic of index l (l + 1) + m by its definition: sqrt(2) N P_l^|m|(z) times cos(m phi), or sin(|m| phi) for
/// negative m, without the Condon-Shortley sign.
fn harmonic(index: usize, direction: DVec3) -> f64 {
    let l = index.isqrt();
    let place = index - l * l;
    let m = place.abs_diff(l);
    let factorial = |n: usize| (1..=n).map(|k| k as f64).product::<f64>();
    let norm = ((2 * l + 1) as f64 / (4.0 * PI) * factorial(l - m) / factorial(l + m)).sqrt();
    let angle = m as f64 * atan2(direction.y, direction.x);
    let (sine, cosine) = sin_cos(angle);
    let azimuth = match place.cmp(&l) {
        std::cmp::Ordering::Less => 2.0_f64.sqrt() * sine,
        std::cmp::Ordering::Equal => 1.0,
        std::cmp::Ordering::Greater => 2.0_f64.sqrt() * cosine,
    };
    norm * legendre(l, m, direction.z) * azimuth
}

/// The associated Legendre function P_l^m without sign: (1 - z^2)^(m/2) times the m-th derivative of P_l, as a sum of
/// powers by Rodrigues' formula.
fn legendre(l: usize, m: usize, z: f64) -> f64 {
    let factorial = |n: usize| (1..=n).map(|k| k as f64).product::<f64>();
    let power = |x: f64, n: usize| (0..n).fold(1.0, |product, _| product * x);
    // P_l = 2^-l sum_k (-1)^k (2l - 2k)! / (k! (l - k)! (l - 2k)!) z^(l - 2k)
    let mut sum = 0.0;
    for k in 0..=(l - m) / 2 {
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        let coefficient = factorial(2 * l - 2 * k) / (factorial(k) * factorial(l - k) * factorial(l - 2 * k - m));
        sum += sign * coefficient * power(z, l - 2 * k - m);
    }
    power((1.0 - z * z).max(0.0).sqrt(), m) * sum / power(2.0, l)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sphere::harmonics;

    #[test]
    fn harmonics_by_definition_are_those_by_recurrence() {
        let directions = [DVec3::new(2.0, -3.0, 6.0) / 7.0, DVec3::new(-6.0, 2.0, -3.0) / 7.0, DVec3::Z, -DVec3::X];
        for direction in directions {
            let mut values = [0.0; 100];
            harmonics(10, direction, &mut values);
            for (index, value) in values.into_iter().enumerate() {
                let found = harmonic(index, direction);
                assert!((found - value).abs() < 1e-10, "{index} at {direction}: {found} {value}");
            }
        }
    }
}
