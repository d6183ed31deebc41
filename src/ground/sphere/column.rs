//! Heights of a column of directions, anywhere between others, with weights that integrate polynomials exactly.

use std::f64::consts::PI;

use crate::elementary;
use crate::linalg::{Lu, Matrix};
use crate::quadrature::legendre_polynomials;

/// Heights more than the degree plus one that a column has: with so many, every weight is more than 0.8 of that of the
/// plain sum.
const SPARE: usize = 2;

/// Heights from 0 to 1 and their weights, which sum to 1 and integrate polynomials in z of a degree exactly.
///
/// With z = (1 - cos a) / 2, the angles a are equidistant from 0 to pi, the first at a share `phase` of a step. The
/// weights are those of the plain sum over angles, `sin(a) pi / (2 count)`, times 1 and a polynomial in z: of all
/// exact ones those that differ least. `None` if the heights are too few for that.
pub(super) fn column(count: usize, phase: f64, degree: usize) -> Option<Vec<(f64, f64)>> {
    if count < degree + 1 + SPARE {
        return None;
    }
    let angles = (0..count).map(|i| (i as f64 + phase) * PI / count as f64);
    // z = sin(a / 2)^2 keeps the digits of small heights.
    let plain: Vec<(f64, f64)> = angles
        .map(|angle| {
            let half = elementary::sin_cos(angle / 2.0).0;
            (half * half, elementary::sin_cos(angle).0 * PI / (2 * count) as f64)
        })
        .collect();
    let polynomials = |z: f64| legendre_polynomials(2.0 * z - 1.0).take(degree + 1).map(|[value, _]| value).collect();
    let values: Vec<Vec<f64>> = plain.iter().map(|&(z, _)| polynomials(z)).collect();
    let sum = |term: &dyn Fn(&[f64]) -> f64| -> f64 {
        plain.iter().zip(&values).map(|(&(_, weight), values)| weight * term(values)).sum()
    };
    let size = degree + 1;
    let products = (0..size * size).map(|at| sum(&|values| values[at / size] * values[at % size]));
    let products = Matrix::new([size; 2], products.collect()).ok()?;
    // The integral of the first polynomial is 1, of the others 0.
    let missing: Vec<f64> = (0..size).map(|i| f64::from(u8::from(i == 0)) - sum(&|values| values[i])).collect();
    let factors = Lu::new(&products).ok()?.solve(&missing);
    let change = |values: &[f64]| -> f64 { values.iter().zip(&factors).map(|(value, factor)| value * factor).sum() };
    Some(plain.iter().zip(&values).map(|(&(z, weight), values)| (z, weight * (1.0 + change(values)))).collect())
}
