//! Rotation of functions on the sphere.

use std::sync::OnceLock;

use glam::{DMat3, DVec3};

use super::harmonics::{MAX_ORDER, function_count, harmonics};
use super::rule::DirectionRule;
use crate::elementary::on_circle;
use crate::error::{InputError, ensure, input_error};
use crate::linalg::dot;

/// Maximum deviation of an element of R^T R from the identity: it accepts frames computed in f64, but not frames
/// rounded to f32.
pub const MAX_SKEW: f64 = 1e-9;

/// Directions of a rule for one order, and the product of weight and harmonics for each direction.
struct RotationRule {
    directions: Vec<DVec3>,
    weighted: Vec<f64>,
}

/// One rule per order, initialised on first use.
static RULES: [OnceLock<RotationRule>; MAX_ORDER] = [const { OnceLock::new() }; MAX_ORDER];

/// Rotation of coefficients: one matrix per band.
///
/// Element (i, j) is the integral of y_i(R v) y_j(v), computed by a rule that is exact for this integrand.
#[derive(Clone, Debug, PartialEq)]
pub struct HarmonicRotation {
    order: usize,
    /// Row-major blocks, of 2 l + 1 rows and columns, from l = 0 up.
    bands: Vec<f64>,
}

impl HarmonicRotation {
    /// Creates the rotation of an order from a matrix R: (R f)(R v) = f(v).
    pub fn new(order: usize, rotation: &DMat3) -> Result<Self, InputError> {
        check_rotation(rotation)?;
        let count = function_count(order);
        let rule = RULES[order - 1].get_or_init(|| rotation_rule(order));
        let mut turned = [0.0; MAX_ORDER * MAX_ORDER];
        let mut bands = vec![0.0; first_of_band(order)];
        for (&direction, weighted) in rule.directions.iter().zip(rule.weighted.chunks_exact(count)) {
            harmonics(order, *rotation * direction, &mut turned[..count]);
            let mut rest = bands.as_mut_slice();
            for l in 0..order {
                let (band, functions) = (2 * l + 1, l * l..(l + 1) * (l + 1));
                let (block, after) = rest.split_at_mut(band * band);
                for (row, y) in block.chunks_exact_mut(band).zip(&turned[functions.clone()]) {
                    row.iter_mut().zip(&weighted[functions.clone()]).for_each(|(sum, from)| *sum += y * from);
                }
                rest = after;
            }
        }
        Ok(Self { order, bands })
    }

    /// Order n of the harmonics.
    pub const fn order(&self) -> usize {
        self.order
    }

    /// Matrix of a band, with 2 l + 1 rows and columns, row by row. Panics if there is no such band.
    pub fn band(&self, l: usize) -> &[f64] {
        assert!(l < self.order, "a band of order {}", self.order);
        &self.bands[first_of_band(l)..first_of_band(l + 1)]
    }

    /// Computes the coefficients of the rotated function. Panics if a slice does not have n^2 elements.
    pub fn apply(&self, coefficients: &[f64], into: &mut [f64]) {
        let count = function_count(self.order);
        assert_eq!([coefficients.len(), into.len()], [count; 2], "coefficients of order {}", self.order);
        for l in 0..self.order {
            let functions = l * l..(l + 1) * (l + 1);
            for (row, value) in self.band(l).chunks_exact(2 * l + 1).zip(&mut into[functions.clone()]) {
                *value = dot(row, &coefficients[functions.clone()]);
            }
        }
    }
}

fn first_of_band(l: usize) -> usize {
    (0..l).map(|l| (2 * l + 1) * (2 * l + 1)).sum()
}

/// Builds a rule with half of the directions: products of two functions of a band are equal at opposite points, so
/// rings above the equator have double weight.
fn rotation_rule(order: usize) -> RotationRule {
    let whole = DirectionRule::sphere(2 * order - 2);
    let mut rule = RotationRule { directions: Vec::new(), weighted: Vec::new() };
    let mut y = vec![0.0; function_count(order)];
    for (&at, weight) in whole.directions().iter().zip(whole.weights()).filter(|(at, _)| at.z >= 0.0) {
        let weight = if at.z > 0.0 { 2.0 * weight } else { *weight };
        harmonics(order, at, &mut y);
        rule.directions.push(at);
        rule.weighted.extend(y.iter().map(|y| weight * y));
    }
    rule
}

/// Checks that a matrix is a rotation.
pub fn check_rotation(rotation: &DMat3) -> Result<(), InputError> {
    for columns in [[0, 0], [1, 1], [2, 2], [0, 1], [0, 2], [1, 2]] {
        let found = rotation.col(columns[0]).dot(rotation.col(columns[1]));
        let expected = if columns[0] == columns[1] { 1.0 } else { 0.0 };
        let off = (found - expected).abs();
        ensure!(!off.is_nan() && off <= MAX_SKEW, "crossbar::prt::turn" =>
            "expected a rotation matrix with orthonormal columns (to {MAX_SKEW}), found columns {columns:?} (counted \
             from 0) with product {found}; orthonormalize them in double precision");
    }
    if rotation.determinant() < 0.0 {
        Err(input_error!("crossbar::prt::turn" =>
            "expected a rotation matrix, found a reflection (determinant -1); exchange two columns, or negate one"))
    } else {
        Ok(())
    }
}

/// Rotation around +z by a number of full turns, from x to y.
pub fn turn_around_z(turns: f64) -> DMat3 {
    let [c, s] = on_circle(turns);
    DMat3::from_cols(DVec3::new(c, s, 0.0), DVec3::new(-s, c, 0.0), DVec3::Z)
}
