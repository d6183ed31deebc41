//! Reference solution: exit radiance of a vertex under a light of spherical harmonics (section 3.1), in f64, without
//! matrices, rotation of coefficients, compression or a card. Every ray is tested against every triangle.
//!
//! The only arithmetic that it shares with the tested code is the BRDF and the direction rule.

use std::f64::consts::PI;

use glam::DVec3;

use crate::elementary::{atan2, sin_cos};
use crate::sphere::DirectionRule;
use crate::transfer::brdf::Brdf;
use crate::transfer::{LocalFrame, Vertices, plain_hit, plain_origin};

/// Minimum z of a view direction at a vertex: the view of a hit vertex whose normal faces away is raised to it.
const LEAST_HEIGHT: f64 = 1e-6;

/// Input of the reference: vertices, one BRDF per material, and light in global coordinates.
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
    /// The time grows exponentially with the number of bounces, so this is only for small meshes. Panics if there is no
    /// such vertex, or a material has no BRDF.
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

    fn incident_radiance(&self, vertex: usize, frame: &LocalFrame, local: DVec3, bounces: u32) -> f64 {
        let direction = frame.to_global(local);
        let Some((triangle, weights)) = plain_hit(self.vertices, plain_origin(self.vertices, vertex), direction) else {
            return self.light.iter().enumerate().map(|(index, l)| l * harmonic(index, direction)).sum();
        };
        let [a, b, c] = self.vertices.corners(triangle as u32);
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
