//! The truth that links are compared with: equation 9 over all pairs of texels, in f64.
//!
//! Written to be read beside equations 7 to 10, it shares no code with the fast factors: no levels, no table, no
//! moments. A pair of texels that are far apart counts with R_d between their mean points; of a near pair the double
//! integral of equation 10 is taken by a quadrature rule on the triangles of both parts.

use std::f64::consts::PI;
use std::ops::Range;

use glam::DVec3;
use rayon::prelude::*;
use refsim::exec::batch::SimdLevel;

use super::Dipole;
use super::factor::{FactorError, MAX_MM_PER_UNIT, MIN_MM_PER_UNIT};
use crate::atlas::Atlas;

/// Texels nearer than this many times the sum of their radii are integrated.
const NEAR: f64 = 5.0;
/// Texels nearer than this many times the sum of their radii are integrated with triangles no longer than the mean free
/// path.
const CLOSE: f64 = 1.5;
/// Triangles are divided into at most this many along a side.
const MAX_DIVISIONS: u32 = 4;
/// Texels that are handled together.
const CHUNK: usize = 256;
/// Partial sums of a sum over distances.
const LANES: usize = 8;
/// Rows of texels after which progress is told: so many times in all.
const REPORTS: usize = 32;

/// Equation 9 over the texels of an atlas, for one channel. Lengths in mm.
#[derive(Clone, Debug)]
pub struct Reference<'a> {
    atlas: &'a Atlas,
    mm_per_unit: f64,
    r_d: DipoleSum,
    mean_free_path: f64,
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

/// A point of a texel's part and the fraction of the area that it stands for.
type WeightedPoint = (DVec3, f64);

impl<'a> Reference<'a> {
    /// For an atlas of a model with a scale.
    ///
    /// # Errors
    /// [`FactorError::Scale`] if the scale is not from [`MIN_MM_PER_UNIT`] to [`MAX_MM_PER_UNIT`].
    pub fn new(atlas: &'a Atlas, mm_per_unit: f64, dipole: &Dipole) -> Result<Self, FactorError> {
        if !(MIN_MM_PER_UNIT..=MAX_MM_PER_UNIT).contains(&mm_per_unit) {
            return Err(FactorError::Scale { found: mm_per_unit });
        }
        let mut texels = PartColumns::default();
        for (texel, cluster) in atlas.texels().iter().zip(atlas.clusters(0)) {
            texels.x.push(mm_per_unit * texel.point.x);
            texels.y.push(mm_per_unit * texel.point.y);
            texels.z.push(mm_per_unit * texel.point.z);
            texels.area.push(mm_per_unit * mm_per_unit * texel.area);
            texels.radius.push(mm_per_unit * cluster.radius);
        }
        let r_d = DipoleSum::new(dipole);
        Ok(Self { atlas, mm_per_unit, r_d, mean_free_path: dipole.mean_free_path(), texels })
    }

    /// The radiosity of every texel for an irradiance of every texel, row by row: equation 9,
    /// B_i = sum over j of F_ij E_j. `done` is called now and then with the number of rows done and of all.
    ///
    /// # Errors
    /// [`FactorError::Values`] if there is not one irradiance per texel.
    pub fn radiosity(&self, irradiance: &[f64], done: &mut dyn FnMut(usize, usize)) -> Result<Vec<f64>, FactorError> {
        self.radiosity_of_rows(irradiance, 0..self.atlas.side() as usize, done)
    }

    /// The radiosity of the texels of some rows; otherwise as [`Self::radiosity`].
    ///
    /// # Errors
    /// As [`Self::radiosity`].
    pub fn radiosity_of_rows(
        &self,
        irradiance: &[f64],
        rows: Range<usize>,
        done: &mut dyn FnMut(usize, usize),
    ) -> Result<Vec<f64>, FactorError> {
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

    /// The radiosity at a point, in mm: equation 7 with an irradiance that is constant on every texel,
    /// B(x) = sum over j of E_j times the integral over P_j of R_d(x_j, x).
    ///
    /// # Errors
    /// [`FactorError::Values`] if there is not one irradiance per texel.
    pub fn radiosity_at(&self, point: DVec3, irradiance: &[f64]) -> Result<f64, FactorError> {
        let power = self.power(irradiance)?;
        Ok(self.sum(point, 0.0, &power, |j, is_close| {
            let there = self.points(j, is_close);
            self.mean_r_d(&[(point, 1.0)], &there)
        }))
    }

    /// F_ij of equation 10 for two texels, by index: 1 / A_i times the double integral of R_d over both parts.
    ///
    /// # Panics
    /// If there is no such texel.
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

    /// A_j E_j.
    fn power(&self, irradiance: &[f64]) -> Result<Vec<f64>, FactorError> {
        let texels = self.texels.area.len();
        if irradiance.len() != texels {
            return Err(FactorError::Values { found: irradiance.len(), texels });
        }
        Ok(self.texels.area.iter().zip(irradiance).map(|(area, irradiance)| area * irradiance).collect())
    }

    /// B_i.
    fn gather(&self, i: usize, power: &[f64]) -> f64 {
        let mut here: [Option<Vec<WeightedPoint>>; 2] = [None, None];
        self.sum(self.point(i), self.texels.radius[i], power, |j, is_close| {
            let here = here[usize::from(is_close)].get_or_insert_with(|| self.points(i, is_close));
            self.mean_r_d(here, &self.points(j, is_close))
        })
    }

    /// The sum over all texels of power times R_d from the point: of `near(texel, whether it is close)` where they are
    /// near.
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
        self.mean_r_d(&self.points(i, is_close), &self.points(j, is_close))
    }

    /// The mean of R_d over pairs of points.
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

    /// Quadrature points of a texel's part: three per triangle, which is exact for quadratic functions.
    fn points(&self, texel: usize, is_close: bool) -> Vec<WeightedPoint> {
        let part = self.atlas.part(texel as u32);
        let length = 2.0 * self.texels.radius[texel] / self.mean_free_path;
        let divisions = if is_close { (length.ceil() as u32).clamp(1, MAX_DIVISIONS) } else { 1 };
        let mut points = Vec::new();
        let mut area = 0.0;
        for polygon in part.polygons() {
            for k in 2..polygon.len() {
                let triangle = [polygon[0], polygon[k - 1], polygon[k]].map(|corner| self.mm_per_unit * corner);
                area += triangle_points(triangle, divisions, &mut points);
            }
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
                // The part that stands upside down beside it.
                if column + row + 1 < n {
                    points.push((corner + (6.0 - s) / 6.0 * u + (6.0 - t) / 6.0 * v, weight));
                }
            }
        }
    }
    area
}

/// R_d of the dipole, for many distances at once:
/// `alpha' / (4 pi) sum over z of z (sigma_tr + 1/d) e^(-sigma_tr d) / d^2`, d^2 = r^2 + z^2.
#[derive(Clone, Copy, Debug)]
struct DipoleSum {
    scale: f64,
    sigma_tr: f64,
    depths: [f64; 2],
}

impl DipoleSum {
    fn new(dipole: &Dipole) -> Self {
        let scale = dipole.alpha_prime() / (4.0 * PI);
        Self { scale, sigma_tr: dipole.sigma_tr(), depths: [dipole.z_r(), dipole.z_v()] }
    }

    /// R_d at a squared distance.
    #[inline(always)]
    fn at(&self, squared: f64) -> f64 {
        let mut sum = 0.0;
        for z in self.depths {
            let d = (squared + z * z).sqrt();
            let inverse = 1.0 / d;
            sum += z * inverse * ((self.sigma_tr + inverse) * inverse) * exp_of_negative(self.sigma_tr * d);
        }
        self.scale * sum
    }

    /// The sum of weight times R_d, by the widest vectors of the host. Its partial sums, and their order, do not depend
    /// on how wide these are.
    fn sum(&self, squared: &[f64], weights: &[f64]) -> f64 {
        let sums = SimdLevel::widest().run(
            #[inline(always)]
            || {
                let mut sums = [0.0; LANES];
                let (mut distances, mut factors) = (squared.chunks_exact(LANES), weights.chunks_exact(LANES));
                for (squared, weights) in (&mut distances).zip(&mut factors) {
                    for lane in 0..LANES {
                        sums[lane] += weights[lane] * self.at(squared[lane]);
                    }
                }
                for (&squared, &weight) in distances.remainder().iter().zip(factors.remainder()) {
                    sums[0] += weight * self.at(squared);
                }
                sums
            },
        );
        let [a, b, c, d, e, f, g, h] = sums;
        ((a + b) + (c + d)) + ((e + f) + (g + h))
    }
}

/// e^-x for x >= 0, within 4 units in the last place; e^-700 (1e-304) beyond. Compilers turn this one into vector code.
#[inline(always)]
fn exp_of_negative(x: f64) -> f64 {
    const LN_2_HIGH: f64 = 0.693_147_180_369_123_8;
    const LN_2_LOW: f64 = 1.908_214_929_270_587_7e-10;
    // Adding 1.5 x 2^52 rounds to an integer, which the last bits then hold.
    const SHIFT: f64 = 6_755_399_441_055_744.0;
    let x = if x < 700.0 { x } else { 700.0 };
    let shifted = x * std::f64::consts::LOG2_E + SHIFT;
    let halvings = shifted - SHIFT;
    let r = (halvings * LN_2_HIGH - x) + halvings * LN_2_LOW;
    let mut series = 1.0;
    for n in [13.0, 12.0, 11.0, 10.0, 9.0, 8.0, 7.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.0] {
        series = 1.0 + series * (r * (1.0 / n));
    }
    let power = f64::from_bits((1023_u64.wrapping_sub(shifted.to_bits() & 0x7ff)) << 52);
    series * power
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elementary::exp;
    use crate::subsurface::Coefficients;
    use approx::assert_relative_eq;

    #[test]
    fn the_exponential_is_right() {
        for k in 0..200_000 {
            let x = f64::from(k) * 0.0035;
            assert_relative_eq!(exp_of_negative(x), exp(-x), max_relative = 9e-16);
        }
        assert_eq!([exp_of_negative(0.0), exp_of_negative(1e300)], [1.0, exp_of_negative(700.0)]);
    }

    #[test]
    fn r_d_is_the_dipole_s() {
        let dipole = Dipole::new(Coefficients { sigma_s_prime: 2.21, sigma_a: 0.0012 }, 1.3).expect("a medium");
        let sum = DipoleSum::new(&dipole);
        for r in [0.0, 1e-3, 0.5, 3.0, 40.0, 1000.0] {
            assert_relative_eq!(sum.at(r * r), dipole.r_d(r), max_relative = 1e-13);
        }
        let squared: Vec<f64> = (0..7).map(f64::from).collect();
        let direct: f64 = squared.iter().map(|s| s * sum.at(*s)).sum();
        assert_relative_eq!(sum.sum(&squared, &squared), direct, max_relative = 1e-15);
    }

    #[test]
    fn triangles_are_integrated_exactly_to_second_order() {
        let corners = [DVec3::new(0.0, 0.0, 1.0), DVec3::new(3.0, 0.0, 1.0), DVec3::new(1.0, 2.0, 1.0)];
        for n in 1..5 {
            let mut points = Vec::new();
            let area = triangle_points(corners, n, &mut points);
            assert_eq!((area, points.len() as u32), (3.0, 3 * n * n));
            let integral = |value: fn(DVec3) -> f64| points.iter().map(|(p, w)| w * value(*p)).sum::<f64>();
            assert_relative_eq!(integral(|_| 1.0), 3.0, max_relative = 1e-14);
            assert_relative_eq!(integral(|p| p.x), 4.0, max_relative = 1e-14);
            // Area / 12 times (the squares of the corners' coordinates, and of their sum).
            assert_relative_eq!(integral(|p| p.x * p.x), 3.0 / 12.0 * (9.0 + 1.0 + 16.0), max_relative = 1e-14);
            assert_relative_eq!(integral(|p| p.x * p.y), 3.0 / 12.0 * (2.0 + 4.0 * 2.0), max_relative = 1e-14);
        }
    }
}
