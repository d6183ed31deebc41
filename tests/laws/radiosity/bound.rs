//! Error bounds of the f32 iteration of [`CardSystem`].
//!
//! With `A = diag(M)^-1 M`, `e = diag(M)^-1 E` and `G = 1 - A`, the exact step is `x' = e + G x`, and the solution x*
//! is its fixed point. The card's step is the exact step plus d, the rounding errors of the step and of the data. So
//! the error r obeys `r' = G r + d`, and in the infinity norm `|r'| <= g |r| + |d|` with `g = |G|`, the maximum
//! absolute row sum: below 1, since reflectances are. After k steps
//!
//! `|r| <= g^k |r at the start| + max |d| / (1 - g)`.
//!
//! The error of a rounded operation is at most `2^-24` of its result (or 2^-150 near zero), so |d| follows from the
//! results of a step: [`bounded_step`]. Before any step it is bounded by the number of roundings per element:
//! [`before`].

use crossbar::card::Texels;
use crossbar::linalg::Matrix;
use crossbar::radiosity::card_order::CardSystem;
use crossbar::radiosity::packing::Packing;

/// The unit roundoff of f32: half of the distance from 1 to the next number.
const UNIT_F32: f64 = 0.5 * f32::EPSILON as f64;
/// Covers terms of second order in the unit roundoff, and the rounding of the bound itself.
const SLACK: f64 = 1.001;
/// The largest error of an operation near zero.
const TINY: f64 = f32::MIN_POSITIVE as f64 * UNIT_F32;

/// The contraction factor g: the infinity norm (maximum absolute row sum) of `1 - diag(M)^-1 M`.
pub(super) fn contraction(matrix: &Matrix) -> f64 {
    let of_row = |(i, row): (usize, &[f64])| {
        let all: f64 = row.iter().map(|m| m.abs()).sum();
        all / row[i].abs() - 1.0
    };
    matrix.rows().enumerate().map(of_row).fold(0.0, f64::max)
}

/// A bound on the error of a channel in the infinity norm, updated step by step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ErrorBound {
    /// The contraction factor g, at least 0.
    pub(super) contraction: f64,
    /// The bound so far.
    pub(super) error: f64,
}

impl ErrorBound {
    /// The initial bound for an iteration that starts from 0: x* is at most `|e| / (1 - g)` away. `largest` is `|e|`,
    /// the largest element of `diag(M)^-1 E`.
    pub(super) fn from_zero(contraction: f64, largest: f64) -> Self {
        Self { contraction, error: largest / (1.0 - contraction) }
    }

    /// Updates the bound for a step with a rounding error of at most `step`.
    pub(super) fn advance(&mut self, step: f64) {
        self.error = (self.contraction * self.error + step) * (1.0 + f64::EPSILON);
    }
}

/// Sums of the magnitudes of a row's rounded results, for each channel.
#[derive(Clone, Copy, Default)]
struct Magnitudes {
    sums: [f64; 4],
    products: [f64; 4],
    operations: u32,
}

impl Magnitudes {
    fn sum(&mut self, value: [f32; 4]) -> [f32; 4] {
        self.sums.iter_mut().zip(value).for_each(|(sum, x)| *sum += f64::from(x.abs()));
        value
    }

    /// Subtracts the products of a row from `start`, in the order of the texels.
    fn row(&mut self, start: [f32; 4], matrix: &[[f32; 4]], radiosity: &[[f32; 4]]) -> [f32; 4] {
        matrix.iter().zip(radiosity).fold(start, |acc, (m, b)| {
            let product = [0, 1, 2, 3].map(|c| m[c] * b[c]);
            self.operations += 1;
            self.products.iter_mut().zip(product).for_each(|(sum, x)| *sum += f64::from(x.abs()));
            self.sum([0, 1, 2, 3].map(|c| acc[c] - product[c]))
        })
    }

    /// A bound on |d| per channel: the rounding errors of all operations, and of the data, which products propagate.
    /// `e` is the element of the right-hand side.
    fn bound(&self, e: [f64; 4]) -> [f64; 4] {
        let tiny = TINY * f64::from(4 * self.operations + 16);
        [0, 1, 2, 3].map(|c| SLACK * UNIT_F32 * (self.sums[c] + 2.0 * self.products[c] + e[c].abs()) + tiny)
    }
}

/// A step, and a bound per channel on its distance from the exact step on the unrounded system, in the infinity norm.
/// With four elements per texel all four bounds are the same number.
pub(super) fn bounded_step(card: &CardSystem, radiosity: &Texels) -> (Texels, [f64; 4]) {
    let (mut step, mut largest) = (card.zero(), [0.0_f64; 4]);
    for i in 0..card.matrix().height {
        let (mut total, matrix, b) = (Magnitudes::default(), card.matrix().row(i), &radiosity.texels[..]);
        let bound = match card.packing() {
            Packing::Rgb => {
                let e = card.emittance().texels[i];
                let begin = total.sum([0, 1, 2, 3].map(|c| b[i][c] + e[c]));
                step.texels[i] = total.row(begin, matrix, b);
                total.bound(e.map(f64::from))
            }
            Packing::Luminance => {
                let (x, c) = (i / 4, i % 4);
                let e = card.emittance().texels[x][c];
                let mut partial = total.sum([b[x][c] + e; 4])[0];
                for (matrix, b) in matrix.chunks(card.block()).zip(b.chunks(card.block())) {
                    let [x, y, z, w] = total.row([0.0; 4], matrix, b);
                    partial = total.sum([x + y, (x + y) + z, ((x + y) + z) + w, partial + (((x + y) + z) + w)])[3];
                }
                step.texels[x][c] = partial;
                [total.bound([f64::from(e), 0.0, 0.0, 0.0]).iter().sum(); 4]
            }
        };
        largest = [0, 1, 2, 3].map(|c| largest[c].max(bound[c]));
    }
    (step, largest)
}

/// An a-priori bound on the error that rounding causes in any number of steps: `d / (1 - g)`, where an element of a
/// step has k roundings (k depends on the layout) and a relative error of `gamma = k u / (1 - k u)` of the magnitudes
/// that are summed. Starting from 0, add `g^steps |e| / (1 - g)` for the error of the initial guess. Infinite if k u or
/// g is not below 1.
pub(super) fn before(card: &CardSystem, contraction: f64, largest: f64) -> f64 {
    let texels = card.matrix().width;
    let roundings = match card.packing() {
        Packing::Rgb => texels + 3,
        Packing::Luminance => texels + card.passes() + 6,
    };
    let k = roundings as f64 * UNIT_F32;
    let (gamma, open) = (SLACK * k / (1.0 - k), 1.0 - contraction);
    // |x| + |e| + sum |a| |x| <= (2 + g) |x| + |e|, and |x| is at most |x*| plus the error; starting from 0, x
    // approaches x* from below.
    let size = largest / open;
    let grows = gamma * (2.0 + contraction) / open;
    if !(k < 1.0 && open > 0.0 && grows < 1.0) {
        return f64::INFINITY;
    }
    gamma * ((2.0 + contraction) * size + largest) / (1.0 - grows) / open
}
