//! Sums of numbers of a float format in one adder, on rows: computed lane by lane in doubles, before rounding. One
//! function serves every format; only the rounding of the row of doubles is compiled per format.

use super::code::Slot;
use super::slots::Slots;
use crate::lanes::{AnyLane, LANES, LaneRow, SimdLevel, add_odd};
use crate::num::{Format, FormatKind, Rounding};

const SIGN: u64 = 1 << 63;

/// Kind of sum.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum RowSum {
    /// Sum of the first numbers, aligned to the largest exponent and truncated.
    Aligned {
        /// Number of addends, 1 to 4.
        terms: u8,
        /// Bits kept below the largest exponent, at most 28.
        bits: u8,
    },
    /// `a b + c` of the first three numbers, with the product truncated to the significand of the format.
    ProductCut,
}

impl RowSum {
    /// Number of rows read.
    pub const fn operands(self) -> usize {
        match self {
            Self::Aligned { terms, .. } => terms as usize,
            Self::ProductCut => 3,
        }
    }
}

/// Computes sums of rows of numbers of a float format, in the arithmetic `lane`.
pub fn add_rows(
    format: Format,
    lane: &AnyLane,
    simd: SimdLevel,
    sum: RowSum,
    (args, to): ([Slot; 4], Slot),
    slots: &mut Slots,
) {
    let down = format.rounding == Rounding::Down;
    let Slots { rows, scratch, wide, .. } = slots;
    let [a, b, c, d] = args.map(|slot| &**rows[usize::from(slot)]);
    let rows = [a, b, c, d];
    simd.run(
        #[inline(always)]
        || match sum {
            RowSum::Aligned { terms: 1, bits } => each(rows, wide, |[a, ..]| aligned([a], bits, down)),
            RowSum::Aligned { terms: 2, bits } => each(rows, wide, |[a, b, ..]| aligned([a, b], bits, down)),
            RowSum::Aligned { terms: 3, bits } => each(rows, wide, |[a, b, c, _]| aligned([a, b, c], bits, down)),
            RowSum::Aligned { bits, .. } => each(rows, wide, |numbers| aligned(numbers, bits, down)),
            RowSum::ProductCut => each(rows, wide, |numbers| product_cut(format, numbers, down)),
        },
    );
    lane.round_row(simd, wide, scratch);
    slots.commit(to);
}

/// Applies a function to rows of singles.
#[inline(always)]
fn each([a, b, c, d]: [&LaneRow; 4], wide: &mut [f64; LANES], f: impl Fn([f64; 4]) -> f64) {
    for i in 0..LANES {
        wide[i] = f([a[i], b[i], c[i], d[i]].map(|raw| f64::from(f32::from_bits(raw))));
    }
}

/// The sum of numbers, exact except for bits that alignment drops. Branch-free.
#[inline(always)]
fn aligned<const N: usize>(numbers: [f64; N], bits: u8, down: bool) -> f64 {
    const FIELD: u64 = 0x7ff << 52;
    let (mut plain, mut largest, mut signs, mut all) = (0.0, 0.0, 0, u64::MAX);
    for number in numbers {
        plain += number;
        largest = if number.abs() > largest { number.abs() } else { largest };
        (signs, all) = (signs | number.to_bits(), all & number.to_bits());
    }
    let (top, bits) = (largest.to_bits() & FIELD, u64::from(bits) << 52);
    // Powers of two, from exponent fields: `up` scales the last kept bit to 1, `unit` undoes that.
    let (up, unit) = ((2046u64 << 52).wrapping_sub(top).wrapping_add(bits), top.wrapping_sub(bits));
    let mut sum = 0.0;
    for number in numbers {
        sum += (number * f64::from_bits(up)).trunc();
    }
    // Sign of exact cancellation, and of sums of zeros with different signs.
    let none = signed_zero(down).to_bits();
    let zero = if largest == 0.0 { all & SIGN | signs & none } else { none };
    let scaled = if (sum == 0.0) | (largest == 0.0) { f64::from_bits(zero) } else { sum * f64::from_bits(unit) };
    // Singles don't overflow here: non-finite results come from an infinity or a NaN.
    if plain.abs() < f64::INFINITY { scaled } else { plain }
}

/// `a b + c` of the first three numbers, rounded to odd, with the product truncated.
#[inline(always)]
fn product_cut(format: Format, [a, b, c, _]: [f64; 4], down: bool) -> f64 {
    let FormatKind::Float { man_bits, .. } = format.kind else { return f64::NAN };
    let product = f64::from_bits((a * b).to_bits() & (u64::MAX << (52 - u32::from(man_bits))));
    let sum = add_odd(product, c);
    let plus = product.to_bits() | c.to_bits() == 0;
    if sum == 0.0 && down && !plus { -0.0 } else { sum }
}

#[inline(always)]
fn signed_zero(negative: bool) -> f64 {
    if negative { -0.0 } else { 0.0 }
}
