//! Number formats of the sums of dot products.

use super::rules::Rules;
use crate::num::{Format, FormatKind, Overflow, Rounding};

impl Rules {
    /// The accumulator of dot products of pixel arithmetic in a format; `None` if sums are in that format. An
    /// accumulator that [`accumulates`] nothing of a format leaves its sums alone.
    pub(crate) fn accumulator_of(&self, operands: Format) -> Option<Format> {
        self.accumulator.filter(|accumulator| accumulates(*accumulator, operands))
    }
}

/// Format from which an accumulator that does not hold the operands gets their products: rounded to odd, so that a
/// second rounding, to at least two bits less, gives what one would have given.
pub(crate) const PRODUCTS: Format = Format::FP32.with_rounding(Rounding::Odd);

/// Returns `true` if executors can sum products of a format in an accumulator: if it holds all numbers of the operands,
/// or is at least two bits narrower than [`PRODUCTS`], which holds them.
pub(super) fn accumulates(accumulator: Format, operands: Format) -> bool {
    accumulator.holds(operands) || is_narrow(accumulator) && PRODUCTS.holds(operands)
}

/// Returns `true` if rounding a number of [`PRODUCTS`] into a format rounds as the number that was rounded to odd.
fn is_narrow(format: Format) -> bool {
    match format.kind {
        // Under `:nvovf` products of 2^128 and more differ from the largest number; an exact sum of 0 is negative under
        // `:rdn`.
        FormatKind::Float { man_bits, .. } => {
            man_bits <= 21 && format.overflow != Overflow::Nv30 && format.rounding != Rounding::Down
        }
        FormatKind::Fixed { int_bits, frac_bits } => int_bits + frac_bits <= 22 && format.overflow != Overflow::Wrap,
        FormatKind::Normalized { .. } => false,
    }
}

/// Accumulators that a device can have, in words of an error message.
pub(super) const ACCUMULATORS: &str = "an accumulator that holds all numbers of the registers, or one of at most 21 \
     mantissa bits without :nvovf and :rdn, or of at most 22 bits of fixed point without :wrap";
