//! Error bounds of the f32 iteration of [`super::card_order`].
//!
//! With `A = diag(M)^-1 M`, `e = diag(M)^-1 E` and `G = 1 - A`, the exact step is `x' = e + G x`, and the solution x*
//! is its fixed point. The card's step is the exact one plus d, the rounding errors of the step and of the data. So
//! the error r obeys `r' = G r + d`, and in the infinity norm `|r'| <= g |r| + |d|` with `g = |G|`, the maximum
//! absolute row sum: below 1, since reflectances are. After k steps
//!
//! `|r| <= g^k |r at the start| + max |d| / (1 - g)`.
//!
//! A rounded operation is off by at most `2^-24` of its result (or 2^-150 near zero), so |d| follows from the results
//! of a step: [`bounded_step`]. Before any step it is bounded by the number of roundings per element: [`before`].

use super::card_order::{CardSystem, RoundingObserver};
use super::packing::Packing;
use crate::card::Texels;
use crate::linalg::Matrix;

/// The unit roundoff of f32: half of the distance from 1 to the next number.
pub const UNIT_F32: f64 = 0.5 * f32::EPSILON as f64;
/// Covers terms of second order in the unit roundoff, and the rounding of the bound itself.
const SLACK: f64 = 1.001;
/// The largest error of an operation near zero.
const TINY: f64 = f32::MIN_POSITIVE as f64 * UNIT_F32;

/// The contraction factor g: the infinity norm (maximum absolute row sum) of `1 - diag(M)^-1 M`.
pub fn contraction(matrix: &Matrix) -> f64 {
    let of_row = |(i, row): (usize, &[f64])| {
        let all: f64 = row.iter().map(|m| m.abs()).sum();
        all / row[i].abs() - 1.0
    };
    matrix.rows().enumerate().map(of_row).fold(0.0, f64::max)
}

/// A bound on the error of a channel in the infinity norm, updated step by step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorBound {
    /// The contraction factor g, at least 0.
    pub contraction: f64,
    /// The bound so far.
    pub error: f64,
}

impl ErrorBound {
    /// The initial bound for an iteration that starts from 0: x* is at most `|e| / (1 - g)` away. `largest` is `|e|`,
    /// the largest element of `diag(M)^-1 E`.
    pub fn from_zero(contraction: f64, largest: f64) -> Self {
        Self { contraction, error: largest / (1.0 - contraction) }
    }

    /// Updates the bound for a step with a rounding error of at most `step`.
    pub fn advance(&mut self, step: f64) {
        self.error = (self.contraction * self.error + step) * (1.0 + f64::EPSILON);
    }
}

/// Sums of the magnitudes of a row's results.
#[derive(Clone, Copy, Debug, Default)]
struct Magnitudes {
    sums: [f64; 4],
    products: [f64; 4],
    operations: u32,
}

impl RoundingObserver for Magnitudes {
    fn product(&mut self, value: [f32; 4]) {
        self.operations += 1;
        for (sum, x) in self.products.iter_mut().zip(value) {
            *sum += f64::from(x.abs());
        }
    }

    fn sum(&mut self, value: [f32; 4]) {
        for (sum, x) in self.sums.iter_mut().zip(value) {
            *sum += f64::from(x.abs());
        }
    }
}

impl Magnitudes {
    /// A bound on |d| per channel: the rounding errors of all operations, and of the data, which products propagate.
    /// `e` is the element of the right-hand side.
    fn bound(&self, e: [f64; 4]) -> [f64; 4] {
        let tiny = TINY * f64::from(4 * self.operations + 16);
        [0, 1, 2, 3].map(|c| SLACK * UNIT_F32 * (self.sums[c] + 2.0 * self.products[c] + e[c].abs()) + tiny)
    }
}

/// A step, and a bound per channel on its distance from the exact step on the unrounded system, in the infinity norm.
/// With four elements per texel all four bounds are the same number.
///
/// # Panics
/// If the texture is not a radiosity texture of this system.
pub fn bounded_step(card: &CardSystem, radiosity: &Texels) -> (Texels, [f64; 4]) {
    let rows = card.matrix().height;
    let (mut partial, mut totals) = (card.zero(), vec![Magnitudes::default(); rows]);
    for pass in 0..card.passes() {
        let (next, observed) = card.observed(radiosity, &partial, pass, |_| Magnitudes::default());
        for (total, part) in totals.iter_mut().zip(observed) {
            total.operations += part.operations;
            for c in 0..4 {
                total.sums[c] += part.sums[c];
                total.products[c] += part.products[c];
            }
        }
        partial = next;
    }
    let mut largest = [0.0_f64; 4];
    for (i, total) in totals.iter().enumerate() {
        let bound = match card.packing() {
            Packing::Rgb => total.bound(card.emittance().texels[i].map(f64::from)),
            Packing::Luminance => {
                let e = f64::from(card.emittance().texels[i / 4][i % 4]);
                [total.bound([e, 0.0, 0.0, 0.0]).iter().sum(); 4]
            }
        };
        largest = [0, 1, 2, 3].map(|c| largest[c].max(bound[c]));
    }
    (partial, largest)
}

/// An a-priori bound on the error that rounding causes in any number of steps: `d / (1 - g)`, where an element of a
/// step has k roundings, k depending on the layout, and a relative error of `gamma = k u / (1 - k u)` of the
/// magnitudes that are summed. Starting from 0, add `g^steps |e| / (1 - g)` for the error of the initial guess.
/// Infinite where k u is not below 1, or g is not.
pub fn before(card: &CardSystem, contraction: f64, largest: f64) -> f64 {
    let texels = card.matrix().width;
    let roundings = match card.packing() {
        Packing::Rgb => texels + 3,
        Packing::Luminance => texels + card.passes() + 6,
    };
    let k = roundings as f64 * UNIT_F32;
    let (gamma, open) = (SLACK * k / (1.0 - k), 1.0 - contraction);
    // |x| + |e| + sum |a| |x| <= (2 + g) |x| + |e|, and |x| is at most x* plus the error itself; starting from 0 it
    // approaches from below.
    let size = largest / open;
    let grows = gamma * (2.0 + contraction) / open;
    if !(k < 1.0 && open > 0.0 && grows < 1.0) {
        return f64::INFINITY;
    }
    gamma * ((2.0 + contraction) * size + largest) / (1.0 - grows) / open
}
