//! Spheres in closed form: under uniform irradiance, and under any irradiance around an axis by Legendre series.

use std::f64::consts::PI;

use super::dipole::Dipole;
use crate::elementary::{acos, sin_cos};
use crate::quadrature::integral_points;

/// The exitance of a sphere of this radius (mm) under the irradiance 1 everywhere. Chords are shorter than twice the
/// radius and every ring of them has the area of a flat one, so this is [`Dipole::disc`] of twice the radius.
pub fn uniform_sphere(dipole: &Dipole, radius: f64) -> f64 {
    dipole.disc(2.0 * radius)
}

/// The Legendre series of a function of the cosine on [-1, 1]: coefficients of P_0, P_1, ..., P_degree. The function
/// may have kinks at the `breaks`, which are ascending and within (-1, 1).
pub fn legendre_coefficients(degree: usize, breaks: &[f64], value: impl Fn(f64) -> f64) -> Vec<f64> {
    let ends: Vec<f64> = [-1.0].iter().chain(breaks).chain(&[1.0]).copied().collect();
    let mut sums = vec![0.0; degree + 1];
    // Sixteen points in angle integrate a panel in which P_degree turns once.
    for pair in ends.windows(2) {
        let [from, to] = [pair[0], pair[1]].map(acos);
        let panels = (from - to) / panel(degree);
        let panels = panels.ceil().max(1.0);
        for i in 0..panels as u32 {
            let at = |i: u32| to + (from - to) * f64::from(i) / panels;
            for (angle, weight) in integral_points(at(i), at(i + 1)) {
                let (sine, cosine) = sin_cos(angle);
                add_legendre(&mut sums, cosine, weight * sine * value(cosine));
            }
        }
    }
    sums.iter().enumerate().map(|(l, sum)| (l as f64 + 0.5) * sum).collect()
}

/// The sum of a Legendre series.
pub fn legendre_sum(coefficients: &[f64], cosine: f64) -> f64 {
    let mut sum = 0.0;
    legendre(coefficients.len(), cosine, |l, p| sum += coefficients[l] * p);
    sum
}

/// The exitance of a sphere from its irradiance, term by term: the convolution with R_d of the chord multiplies the
/// coefficient of P_l by a number (Funk and Hecke).
#[derive(Clone, Debug, PartialEq)]
pub struct SphereSeries {
    factors: Vec<f64>,
}

impl SphereSeries {
    /// The series of a sphere of this radius (mm) up to P_degree.
    pub fn new(dipole: &Dipole, radius: f64, degree: usize) -> Self {
        let mut factors = vec![0.0; degree + 1];
        let widest = panel(degree);
        // R_d falls within a mean free path: panels double from there.
        let (mut from, mut width) = (0.0, (0.5 * dipole.mean_free_path() / radius).min(widest));
        while from < PI {
            let to = (from + width).min(PI);
            for (angle, weight) in integral_points(from, to) {
                let (half, _) = sin_cos(0.5 * angle);
                let (sine, cosine) = sin_cos(angle);
                let area = 2.0 * PI * radius * radius * sine;
                add_legendre(&mut factors, cosine, weight * area * dipole.r_d(2.0 * radius * half));
            }
            from = to;
            width = from.min(widest);
        }
        Self { factors }
    }

    /// Factor of each Legendre coefficient of the irradiance; the first is [`uniform_sphere`].
    pub fn factors(&self) -> &[f64] {
        &self.factors
    }

    /// The Legendre coefficients of the exitance. Terms beyond the series' degree are left out.
    pub fn exitance(&self, irradiance: &[f64]) -> Vec<f64> {
        irradiance.iter().zip(&self.factors).map(|(e, factor)| e * factor).collect()
    }
}

/// The widest panel of angles for polynomials of a degree.
fn panel(degree: usize) -> f64 {
    2.0 * PI / (degree as f64 + 8.0)
}

fn add_legendre(sums: &mut [f64], cosine: f64, weight: f64) {
    legendre(sums.len(), cosine, |l, p| sums[l] += weight * p);
}

/// P_0 to P_(count - 1) at a cosine, by the three-term recurrence.
fn legendre(count: usize, x: f64, mut visit: impl FnMut(usize, f64)) {
    let [mut before, mut now] = [0.0, 1.0];
    for l in 0..count {
        visit(l, now);
        let n = l as f64;
        [before, now] = [now, ((2.0 * n + 1.0) * x * now - n * before) / (n + 1.0)];
    }
}
