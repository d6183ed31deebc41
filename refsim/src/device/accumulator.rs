//! Number formats of the sums of dot products.

use super::rules::Rules;
use crate::num::{Format, FormatKind, Overflow, Rounding};

impl Rules {
    /// The accumulator of dot products in a pixel format; `None` if they are summed in that format itself, because
    /// there is no accumulator or because it cannot sum the products ([`accumulates`]).
    pub(crate) fn accumulator_of(&self, operands: Format) -> Option<Format> {
        self.accumulator.filter(|accumulator| accumulates(*accumulator, operands))
    }
}

/// The format of products for an accumulator that does not hold all operands. Products are rounded to odd, so a second
/// rounding to a format of at least two bits less equals a single rounding.
pub(crate) const PRODUCTS: Format = Format::FP32.with_rounding(Rounding::Odd);

/// Returns `true` if executors can sum products in an accumulator: it holds all numbers of the operands, or it is at
/// least two bits narrower than [`PRODUCTS`], which holds the operands.
pub(super) fn accumulates(accumulator: Format, operands: Format) -> bool {
    accumulator.holds(operands) || is_narrow(accumulator) && PRODUCTS.holds(operands)
}

/// Returns `true` if rounding a number of [`PRODUCTS`] into a format equals rounding the exact product.
fn is_narrow(format: Format) -> bool {
    match format.kind {
        // Not narrow: `:nvovf` distinguishes products of 2^128 and more from the largest number, and `:rdn` makes an
        // exact sum of 0 negative.
        FormatKind::Float { man_bits, .. } => {
            man_bits <= 21 && format.overflow != Overflow::Nv30 && format.rounding != Rounding::Down
        }
        FormatKind::Fixed { int_bits, frac_bits } => int_bits + frac_bits <= 22 && format.overflow != Overflow::Wrap,
        FormatKind::Normalized { .. } => false,
    }
}

/// Description of the possible accumulators, for an error message.
pub(super) const ACCUMULATORS: &str = "an accumulator that holds all numbers of the registers, or one of at most 21 \
     mantissa bits without :nvovf and :rdn, or of at most 22 bits of fixed point without :wrap";
