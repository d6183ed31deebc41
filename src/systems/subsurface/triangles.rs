//! Integrals of R_d from a point over triangles of any size, by bisection.

use glam::DVec3;

use super::Dipole;
use super::dipole_sum::DipoleSum;

/// A triangle is small if its radius times the logarithmic derivative of R_d, at most 3/d + sigma_tr, is at most this.
const SMALL: f64 = 1.5;
/// Triangles whose light is at most this fraction of the plane's total are not divided.
const NEGLIGIBLE: f64 = 1e-5;
/// Maximum number of bisections of a triangle; rounding of coordinates ends bisection earlier.
const MAX_BISECTIONS: u32 = 128;
/// Number of distances that are summed together.
const CHUNK: usize = 256;
const ROOT_15: f64 = 3.872_983_346_207_417;
/// Radon's rule of degree 5: two orbits of three points, each with the barycentric weight of the two equal corners and
/// the weight of the point. The centroid has weight 9/40.
const ORBITS: [(f64, f64); 2] =
    [((6.0 - ROOT_15) / 21.0, (155.0 - ROOT_15) / 1200.0), ((6.0 + ROOT_15) / 21.0, (155.0 + ROOT_15) / 1200.0)];

/// Integrates R_d from points, and holds the buffers for it.
#[derive(Debug)]
pub(super) struct TriangleIntegrals<'a> {
    r_d: &'a DipoleSum,
    dipole: &'a Dipole,
    pending: Vec<([DVec3; 3], u32)>,
    squared: Vec<f64>,
    weights: Vec<f64>,
}

impl<'a> TriangleIntegrals<'a> {
    pub(super) fn new(r_d: &'a DipoleSum, dipole: &'a Dipole) -> Self {
        Self { r_d, dipole, pending: Vec::new(), squared: Vec::new(), weights: Vec::new() }
    }

    /// The integral of R_d from a point over triangles, with an error of about 1e-5 of the plane's total per triangle.
    pub(super) fn over(&mut self, point: DVec3, triangles: &[[DVec3; 3]]) -> f64 {
        let (mut sum, depth, least) = (0.0, self.dipole.z_r(), NEGLIGIBLE * self.dipole.total());
        self.pending.extend(triangles.iter().map(|triangle| (*triangle, 0)));
        while let Some((triangle, bisections)) = self.pending.pop() {
            let [a, b, c] = triangle;
            let middle = (a + b + c) / 3.0;
            let radius = triangle.iter().map(|corner| corner.distance_squared(middle)).fold(0.0, f64::max).sqrt();
            let squared = point.distance_squared(middle);
            let slope = 3.0 / (squared + depth * depth).sqrt() + self.dipole.sigma_tr();
            let area = (b - a).cross(c - a).length() / 2.0;
            let nearest = (squared.sqrt() - radius).max(0.0);
            let divides =
                radius * slope > SMALL && bisections < MAX_BISECTIONS && area * self.r_d.at(nearest * nearest) > least;
            if divides {
                let [p, q, r] = from_longest(triangle);
                let half = (p + q) / 2.0;
                self.pending.extend([([p, half, r], bisections + 1), ([half, q, r], bisections + 1)]);
                continue;
            }
            self.squared.push(squared);
            self.weights.push(9.0 / 40.0 * area);
            for (alike, weight) in ORBITS {
                for corner in triangle {
                    let other = alike * (a + b + c) + (1.0 - 3.0 * alike) * corner;
                    self.squared.push(point.distance_squared(other));
                    self.weights.push(weight * area);
                }
            }
            if self.squared.len() >= CHUNK {
                sum += self.flush();
            }
        }
        sum + self.flush()
    }

    fn flush(&mut self) -> f64 {
        let sum = self.r_d.sum(&self.squared, &self.weights);
        self.squared.clear();
        self.weights.clear();
        sum
    }
}

/// The corners in cyclic order, beginning at the longest side.
fn from_longest([a, b, c]: [DVec3; 3]) -> [DVec3; 3] {
    let [ab, bc, ca] = [a.distance_squared(b), b.distance_squared(c), c.distance_squared(a)];
    if ab >= bc && ab >= ca {
        [a, b, c]
    } else if bc >= ca {
        [b, c, a]
    } else {
        [c, a, b]
    }
}
