//! First-order effect of an accumulator with few bits on a solution: why half precision makes a room too dark, and more
//! patches make it darker still.
//!
//! A term t added to a sum S of p mantissa bits counts as t rounded to a multiple of `2^(floor(log2 |S|) - p)`: see "Half
//! floats darken the room" in docs/studies/radiosity.md. The loss d of an iteration is the error of the sum of equation
//! 4, so the error of the solution is `M^-1 d`. [`predicted`] uses sums and terms of the exact solution. The card's sums
//! are smaller where the loss is large, so the prediction is of first order in the loss.

use refsim::num::{Format, FormatKind, Rounding, power_of_two};

use super::System;
use super::packing::Packing;
use super::solve::{self, Options, Solver};
use crate::error::InputError;

/// Precision and layout of a row's sums.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Accumulator {
    /// Explicit mantissa bits: 10 for fp16, 23 for fp32.
    pub mantissa: u8,
    /// The exponent of the smallest normal number, below which steps no longer shrink: -14 for fp16, -126 for fp32.
    pub least_exponent: i32,
    /// Rounding of the sums.
    pub rounding: Rounding,
    /// One sum per channel, or four partial sums per block.
    pub packing: Packing,
    /// Texels of a block.
    pub block: usize,
}

impl Accumulator {
    /// The accumulator of a floating-point register; `None` for fixed point.
    pub fn of(format: &Format, packing: Packing, block: usize) -> Option<Self> {
        let FormatKind::Float { man_bits, .. } = format.kind else { return None };
        let (least_exponent, _) = format.exponents();
        Some(Self { mantissa: man_bits, least_exponent, rounding: format.rounding, packing, block })
    }

    /// The rounding error of adding `term` to `sum`: the change of the sum minus the term.
    fn loss(&self, sum: f64, term: f64) -> f64 {
        let after = sum + term;
        let size = sum.abs().max(after.abs());
        let exponent = (size.to_bits() >> 52) as i32 - 1023;
        let step = power_of_two(exponent.max(self.least_exponent) - i32::from(self.mantissa));
        let steps = term / step;
        let counted = match self.rounding {
            Rounding::NearestEven | Rounding::NearestAway => steps.round_ties_even(),
            Rounding::Down => steps.floor(),
            Rounding::Up => steps.ceil(),
            Rounding::Odd => {
                let units = after / step;
                let floor = units.floor();
                let odd = floor + if floor != units && floor % 2.0 == 0.0 { 1.0 } else { 0.0 };
                steps + (odd - units)
            }
            // On average, stochastic rounding loses nothing.
            Rounding::Stochastic(_) => steps,
            Rounding::TowardZero => {
                if after >= 0.0 {
                    steps.floor()
                } else {
                    steps.ceil()
                }
            }
        };
        counted * step - term
    }

    /// The sum of the rounding errors of a row that starts from `start` and adds the terms.
    fn row(&self, start: f64, terms: &[f64]) -> f64 {
        let mut lost = 0.0;
        let mut add = |sum: &mut f64, term: f64| {
            lost += self.loss(*sum, term);
            *sum += term;
        };
        let mut sum = start;
        match self.packing {
            Packing::Rgb => terms.iter().for_each(|&term| add(&mut sum, term)),
            Packing::Luminance => {
                for block in terms.chunks(4 * self.block.max(1)) {
                    let mut lanes = [0.0; 4];
                    block.iter().enumerate().for_each(|(j, &term)| add(&mut lanes[j % 4], term));
                    let [mut four, y, z, w] = lanes;
                    [y, z, w].into_iter().for_each(|lane| add(&mut four, lane));
                    add(&mut sum, four);
                }
            }
        }
        lost
    }
}

/// The predicted error of each radiosity, to first order. Panics if `exact` has not one radiosity per patch.
pub fn predicted(system: &System, exact: &[[f64; 3]], how: Accumulator) -> Result<Vec<[f64; 3]>, InputError> {
    assert_eq!(exact.len(), system.factors().len(), "one radiosity per patch");
    let mut off = vec![[0.0; 3]; exact.len()];
    for c in 0..3 {
        let matrix = system.matrix(c);
        let row = |i: usize| {
            // Equation 4 divided by the diagonal: B + e - A B.
            let diagonal = matrix.row(i)[i];
            let terms: Vec<f64> = matrix.row(i).iter().zip(exact).map(|(m, b)| -m * b[c] / diagonal).collect();
            how.row(exact[i][c] + system.emittance()[i][c] / diagonal, &terms) * diagonal
        };
        let lost: Vec<f64> = (0..exact.len()).map(row).collect();
        let problem = solve::Problem { matrix: &matrix, right_hand_side: &lost, areas: system.factors().areas() };
        let found = solve::solve(Solver::GaussSeidel, &problem, &Options { tolerance: 1e-6, most_iterations: 1000 })?;
        off.iter_mut().zip(found.radiosity).for_each(|(off, x)| off[c] = x);
    }
    Ok(off)
}
