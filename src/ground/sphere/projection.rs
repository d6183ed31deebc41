//! Projections of functions on the hemisphere z >= 0 to coefficients, and their errors (section 9.2).

use glam::DVec3;

use super::harmonics::{coupling, function_band, function_count, function_index, harmonics};
use super::hemisphere::Hemisphere;
use super::rule::DirectionRule;
use crate::error::InputError;
use crate::linalg::{Matrix, SymmetricEigen};

/// Projection of functions on the hemisphere z >= 0 to harmonics.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, strum::EnumIter)]
pub enum HemisphereProjection {
    /// Least squared error over the hemisphere: A^-1 b.
    LeastSquares,
    /// Zero below the horizon: b.
    ZeroHemisphere,
    /// Odd reflection, f(x, y, -z) = -f(x, y, z): 2b where l + m is odd, otherwise 0.
    OddReflection,
    /// Even reflection, f(x, y, -z) = f(x, y, z): 2b where l + m is even, otherwise 0.
    EvenReflection,
    /// Odd reflection of z f, which is continuous at the horizon, with its projection divided by z: functions of order
    /// n - 1 with even l + m.
    ScaledOddReflection,
}

/// Squared error over the hemisphere, relative to a squared norm of 1 over the whole sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProjectionErrors {
    /// Error of the worst function of the order: the largest eigenvalue of Q.
    pub worst: f64,
    /// Mean error over all functions of the order: the mean eigenvalue of Q.
    pub average: f64,
}

impl HemisphereProjection {
    /// Returns `true` if the projection can give the function with this index a non-zero coefficient.
    pub fn uses(self, order: usize, index: usize) -> bool {
        let (l, m) = function_band(index);
        let odd = (l + m.unsigned_abs()) % 2 == 1;
        match self {
            Self::LeastSquares | Self::ZeroHemisphere => l < order,
            Self::OddReflection => l < order && odd,
            Self::EvenReflection => l < order && !odd,
            Self::ScaledOddReflection => l + 1 < order && !odd,
        }
    }

    /// Computes the n^2 coefficients of a function by a rule over the hemisphere. Panics if the order is not 1 to 10.
    pub fn project(self, order: usize, rule: &DirectionRule, value: impl Fn(DVec3) -> f64) -> Vec<f64> {
        let mut b = match self {
            Self::ScaledOddReflection => rule.project(order, |v| v.z * value(v)),
            _ => rule.project(order, value),
        };
        match self {
            Self::LeastSquares => return Hemisphere::new(order).least_squares(&b),
            Self::ZeroHemisphere => return b,
            Self::ScaledOddReflection => b = divided_by_z(order, &b),
            Self::OddReflection | Self::EvenReflection => {}
        }
        for (index, coefficient) in b.iter_mut().enumerate() {
            *coefficient *= if self.uses(order, index) { 2.0 } else { 0.0 };
        }
        b
    }

    /// Computes the errors of projections to `order` of the functions spanned by the harmonics of `signal_order`.
    ///
    /// With P the matrix of the projection, E_1 and E_2 of the paper are c^T Q c with Q = (P - I)^T A (P - I).
    pub fn error(self, signal_order: usize, order: usize) -> Result<ProjectionErrors, InputError> {
        let rule = DirectionRule::hemisphere(signal_order + order - 1);
        let larger = signal_order.max(order);
        let [rows, columns] = [function_count(larger), function_count(signal_order)];
        let small = "at most 100 rows and columns";
        let mut differences = Matrix::zeros([columns, rows]).expect(small);
        for index in 0..columns {
            let signal = |v: DVec3| {
                let mut y = [0.0; 100];
                harmonics(signal_order, v, &mut y[..columns]);
                y[index]
            };
            let row = differences.row_mut(index);
            row[..function_count(order)].copy_from_slice(&self.project(order, &rule, signal));
            row[index] -= 1.0;
        }
        let weighted = differences.product(Hemisphere::new(larger).gram()).expect(small);
        let q = weighted.product(&differences.transposed()).expect(small);
        let eigen = SymmetricEigen::new(&q)?;
        Ok(ProjectionErrors { worst: eigen.values[0], average: q.diagonal().iter().sum::<f64>() / columns as f64 })
    }
}

/// Coefficients of g / z, where g is the part of odd l + m of the function with these coefficients. g is 0 at z = 0, so
/// that the quotient is a polynomial, one degree lower.
fn divided_by_z(order: usize, g: &[f64]) -> Vec<f64> {
    let mut quotient = vec![0.0; g.len()];
    for index in (0..g.len()).rev().filter(|&index| HemisphereProjection::ScaledOddReflection.uses(order, index)) {
        let (l, m) = function_band(index);
        // z y_l = k_(l+1) y_(l+1) + k_l y_(l-1), so g_(l+1) = k_(l+1) q_l + k_(l+2) q_(l+2).
        let [above, next] = [l + 1, l + 2].map(|l| coupling(l, m.unsigned_abs()));
        let beyond = if l + 2 < order { next * quotient[function_index(l + 2, m)] } else { 0.0 };
        quotient[index] = (g[function_index(l + 1, m)] - beyond) / above;
    }
    quotient
}
