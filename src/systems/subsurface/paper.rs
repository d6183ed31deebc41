//! Equations 9 and 10 over all pairs of texels in plain f64, the reference for links. It shares no code with the fast
//! factors: no levels, no table, no moments.
//!
//! For far texels, the factor uses R_d between their mean points; for near texels, the double integral of equation 10
//! is computed by a quadrature rule on the triangles of both parts. If one of two close texels exceeds
//! [`MAX_DIVISIONS`] mean free paths, such a rule misses the peak of R_d. The inner integral is then computed by
//! bisection ([`super::triangles`]), so that the light of a point is complete even for large texels.

use std::ops::Range;

use glam::DVec3;
use rayon::prelude::*;
use refsim::exec::batch::SimdLevel;

use super::Dipole;
use super::dipole_sum::DipoleSum;
use super::multipole::{check_scale, check_values};
use super::triangles::TriangleIntegrals;
use crate::atlas::Atlas;
use crate::error::InputError;
use crate::quadrature::FIVE;

/// Texels nearer than this multiple of the sum of their radii are integrated.
const NEAR: f64 = 5.0;
/// Texels nearer than this multiple of their radii are integrated with triangles no longer than the mean free path.
const CLOSE: f64 = 1.5;
/// Maximum number of divisions of a triangle's side, which suffices for texels of up to this many mean free paths.
const MAX_DIVISIONS: u32 = 4;
/// Number of mean free paths beyond which all of a texel's light stays in the texel, within 1e-5.
const MAX_LENGTH: f64 = 1e6;
/// Number of texels that are processed together.
const CHUNK: usize = 256;
const REPORTS: usize = 32;

/// Equation 9 over the texels of an atlas, for one channel, with lengths in mm.
#[derive(Clone, Debug)]
pub struct Reference<'a> {
    atlas: &'a Atlas,
    mm_per_unit: f64,
    dipole: Dipole,
    r_d: DipoleSum,
    texels: PartColumns,
}

/// Mean points, areas and radii of the parts of all texels, row by row.
#[derive(Clone, Debug, Default)]
struct PartColumns {
    x: Vec<f64>,
    y: Vec<f64>,
    z: Vec<f64>,
    area: Vec<f64>,
    radius: Vec<f64>,
}

/// A point of a texel's part and the fraction of the area that it represents.
type WeightedPoint = (DVec3, f64);

impl<'a> Reference<'a> {
    /// Creates the reference for an atlas of a model with a scale.
    pub fn new(atlas: &'a Atlas, mm_per_unit: f64, dipole: &Dipole) -> Result<Self, InputError> {
        check_scale(mm_per_unit)?;
        let mut texels = PartColumns::default();
        for (texel, cluster) in atlas.texels().iter().zip(atlas.clusters(0)) {
            texels.x.push(mm_per_unit * texel.point.x);
            texels.y.push(mm_per_unit * texel.point.y);
            texels.z.push(mm_per_unit * texel.point.z);
            texels.area.push(mm_per_unit * mm_per_unit * texel.area);
            texels.radius.push(mm_per_unit * cluster.radius);
        }
        Ok(Self { atlas, mm_per_unit, dipole: *dipole, r_d: DipoleSum::new(dipole), texels })
    }

    /// The radiosity of the texels of some rows for an irradiance of every texel, row by row: equation 9, B_i = sum over
    /// j of F_ij E_j. `done` is called repeatedly with the number of finished rows and of all these rows.
    pub fn radiosity(
        &self,
        irradiance: &[f64],
        rows: Range<usize>,
        done: &mut dyn FnMut(usize, usize),
    ) -> Result<Vec<f64>, InputError> {
        let power = self.power(irradiance)?;
        let side = self.atlas.side() as usize;
        let mut radiosity = Vec::with_capacity(rows.len() * side);
        let step = side.div_ceil(REPORTS);
        for first in rows.clone().step_by(step) {
            let last = (first + step).min(rows.end);
            radiosity.par_extend((first * side..last * side).into_par_iter().map(|i| self.gather(i, &power)));
            done(last - rows.start, rows.len());
        }
        Ok(radiosity)
    }

    /// F_ij of equation 10 for two texels, by index. Panics if there is no such texel.
    pub fn factor(&self, i: usize, j: usize) -> f64 {
        let reach = self.texels.radius[i] + self.texels.radius[j];
        let distance = self.point(i).distance(self.point(j));
        let mean = if distance < NEAR * reach {
            self.mean_over_pair(i, j, distance < CLOSE * reach)
        } else {
            self.r_d.at(distance * distance)
        };
        self.texels.area[j] * mean
    }

    fn power(&self, irradiance: &[f64]) -> Result<Vec<f64>, InputError> {
        let texels = self.texels.area.len();
        check_values(irradiance.len(), texels)?;
        Ok(self.texels.area.iter().zip(irradiance).map(|(area, irradiance)| area * irradiance).collect())
    }

    fn gather(&self, i: usize, power: &[f64]) -> f64 {
        let mut here: [Option<Vec<WeightedPoint>>; 2] = [None, None];
        self.sum(self.point(i), self.texels.radius[i], power, |j, is_close| {
            if is_close && self.is_long_pair(i, j) {
                return self.mean_over_long_pair(i, j);
            }
            let here = here[usize::from(is_close)].get_or_insert_with(|| self.points(i, is_close));
            self.mean_r_d(here, &self.points(j, is_close))
        })
    }

    /// The sum over all texels of power times R_d, or times `near(texel, is close)` for near texels.
    fn sum(&self, point: DVec3, radius: f64, power: &[f64], mut near: impl FnMut(usize, bool) -> f64) -> f64 {
        let mut sum = 0.0;
        let (mut squared, mut far_power) = ([0.0; CHUNK], [0.0; CHUNK]);
        for first in (0..power.len()).step_by(CHUNK) {
            let count = CHUNK.min(power.len() - first);
            let mut near_count = 0;
            SimdLevel::widest().run(
                #[inline(always)]
                || {
                    for k in 0..count {
                        let j = first + k;
                        let of = &self.texels;
                        let [x, y, z] = [point.x - of.x[j], point.y - of.y[j], point.z - of.z[j]];
                        squared[k] = x * x + y * y + z * z;
                        let reach = NEAR * (radius + of.radius[j]);
                        let is_near = squared[k] < reach * reach;
                        near_count += u32::from(is_near);
                        far_power[k] = if is_near { 0.0 } else { power[j] };
                    }
                },
            );
            sum += self.r_d.sum(&squared[..count], &far_power[..count]);
            if near_count == 0 {
                continue;
            }
            for (j, &squared) in (first..).zip(&squared[..count]) {
                let reach = radius + self.texels.radius[j];
                if squared < NEAR * reach * (NEAR * reach) {
                    sum += power[j] * near(j, squared < CLOSE * reach * (CLOSE * reach));
                }
            }
        }
        sum
    }

    fn point(&self, texel: usize) -> DVec3 {
        DVec3::new(self.texels.x[texel], self.texels.y[texel], self.texels.z[texel])
    }

    fn mean_over_pair(&self, i: usize, j: usize, is_close: bool) -> f64 {
        if is_close && self.is_long_pair(i, j) {
            return self.mean_over_long_pair(i, j);
        }
        self.mean_r_d(&self.points(i, is_close), &self.points(j, is_close))
    }

    /// The length of a texel in mean free paths.
    fn length(&self, texel: usize) -> f64 {
        2.0 * self.texels.radius[texel] / self.dipole.mean_free_path()
    }

    /// Returns `true` if the rule of [`Self::points`] is too coarse for one of two close texels.
    fn is_long_pair(&self, i: usize, j: usize) -> bool {
        let has_area = self.texels.area[i] > 0.0 && self.texels.area[j] > 0.0;
        has_area && self.length(i).max(self.length(j)) > f64::from(MAX_DIVISIONS)
    }

    /// The mean of R_d over the pairs of points of two close texels: the mean, over points of one texel, of the
    /// integral over the other. The points lie on texel i, so that the sum over all texels is complete at each point.
    /// If texel j is much smaller, the points lie on j, because light varies less over it.
    fn mean_over_long_pair(&self, i: usize, j: usize) -> f64 {
        if self.length(i).max(self.length(j)) > MAX_LENGTH {
            return if i == j { self.dipole.total() / self.texels.area[i] } else { 0.0 };
        }
        let [from, to] = if self.texels.radius[j] < 0.5 * self.texels.radius[i] { [j, i] } else { [i, j] };
        let (triangles, mut integrals) = (self.triangles(to), TriangleIntegrals::new(&self.r_d, &self.dipole));
        let area = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a).length() / 2.0;
        let (mut sum, mut weights) = (0.0, 0.0);
        for [a, b, c] in self.triangles(from) {
            // The rule of a square with one side collapsed to corner a.
            for (s, s_weight) in FIVE {
                for (t, t_weight) in FIVE {
                    let point = a + s * ((b - a) + t * (c - b));
                    let weight = area([a, b, c]) * s * s_weight * t_weight;
                    sum += weight * integrals.over(point, &triangles);
                    weights += weight;
                }
            }
        }
        sum / weights / triangles.iter().copied().map(area).sum::<f64>()
    }

    fn triangles(&self, texel: usize) -> Vec<[DVec3; 3]> {
        let (part, mut triangles) = (self.atlas.part(texel as u32), Vec::new());
        for polygon in part.polygons() {
            let fan = (2..polygon.len()).map(|k| [polygon[0], polygon[k - 1], polygon[k]]);
            triangles.extend(fan.map(|triangle| triangle.map(|corner| self.mm_per_unit * corner)));
        }
        triangles
    }

    fn mean_r_d(&self, from: &[WeightedPoint], to: &[WeightedPoint]) -> f64 {
        let mut sum = 0.0;
        let (mut squared, mut weights) = ([0.0; CHUNK], [0.0; CHUNK]);
        for &(point, weight) in from {
            for chunk in to.chunks(CHUNK) {
                for (k, (other, weight)) in chunk.iter().enumerate() {
                    squared[k] = point.distance_squared(*other);
                    weights[k] = *weight;
                }
                sum += weight * self.r_d.sum(&squared[..chunk.len()], &weights[..chunk.len()]);
            }
        }
        sum
    }

    /// Quadrature points of a texel's part: three per piece of a triangle, which is exact for quadratic functions.
    fn points(&self, texel: usize, is_close: bool) -> Vec<WeightedPoint> {
        let divisions = if is_close { (self.length(texel).ceil() as u32).clamp(1, MAX_DIVISIONS) } else { 1 };
        let mut points = Vec::new();
        let mut area = 0.0;
        for triangle in self.triangles(texel) {
            area += triangle_points(triangle, divisions, &mut points);
        }
        if area.is_nan() || area <= 0.0 {
            return vec![(self.point(texel), 1.0)];
        }
        points.iter_mut().for_each(|(_, weight)| *weight /= area);
        points
    }
}

/// Appends the points of a triangle's n x n parts, weighted by area. Returns the triangle's area.
fn triangle_points([a, b, c]: [DVec3; 3], n: u32, points: &mut Vec<WeightedPoint>) -> f64 {
    let (u, v) = ((b - a) / f64::from(n), (c - a) / f64::from(n));
    let area = (b - a).cross(c - a).length() / 2.0;
    let weight = area / f64::from(3 * n * n);
    for row in 0..n {
        for column in 0..n - row {
            let corner = a + f64::from(column) * u + f64::from(row) * v;
            for (s, t) in [(1.0, 1.0), (4.0, 1.0), (1.0, 4.0)] {
                points.push((corner + s / 6.0 * u + t / 6.0 * v, weight));
                // The adjacent part, which is upside down.
                if column + row + 1 < n {
                    points.push((corner + (6.0 - s) / 6.0 * u + (6.0 - t) / 6.0 * v, weight));
                }
            }
        }
    }
    area
}
