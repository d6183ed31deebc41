//! Sums that one adder makes of numbers of a float format, on rows: lane by lane in doubles, which hold the sum before
//! it is rounded. One function serves every format; only the rounding of the row of doubles is compiled for each.

use super::code::Slot;
use super::slots::Slots;
use crate::lanes::{AnyLane, LANES, SimdLevel, add_odd, pow2};
use crate::num::{Format, FormatKind, Rounding};

/// How numbers are added.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum RowSum {
    /// The first numbers, aligned to the largest exponent and cut.
    Aligned {
        /// Number of addends, 1 to 4.
        terms: u8,
        /// Bits kept below the largest exponent, at most 28.
        bits: u8,
    },
    /// `a b + c` of the first three, the product cut to the significand of the format.
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

/// Adds rows of numbers of a float format, whose arithmetic is `lane`.
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
    simd.run(
        #[inline(always)]
        || {
            for i in 0..LANES {
                let numbers = [a[i], b[i], c[i], d[i]].map(|raw| f64::from(f32::from_bits(raw)));
                wide[i] = match sum {
                    RowSum::Aligned { terms, bits } => aligned(numbers, terms, bits, down),
                    RowSum::ProductCut => product_cut(format, numbers, down),
                };
            }
        },
    );
    lane.round_row(simd, wide, scratch);
    slots.commit(to);
}

/// The sum of the first numbers, exact but for the bits that alignment drops.
#[inline(always)]
fn aligned(numbers: [f64; 4], terms: u8, bits: u8, down: bool) -> f64 {
    let (mut plain, mut largest, mut same) = (numbers[0], numbers[0].abs(), true);
    for k in 1..usize::from(terms) {
        plain += numbers[k];
        largest = largest.max(numbers[k].abs());
        same &= numbers[k].is_sign_negative() == numbers[0].is_sign_negative();
    }
    // Singles don't overflow here: what is not finite comes from an infinity or a NaN.
    if plain.abs() >= f64::INFINITY || plain.is_nan() {
        return plain;
    }
    if largest == 0.0 {
        return signed_zero(if same { numbers[0].is_sign_negative() } else { down });
    }
    let exponent = (largest.to_bits() >> 52) as i32 - 1023;
    let (unit, inverse) = (pow2(exponent - i32::from(bits)), pow2(i32::from(bits) - exponent));
    let mut sum = 0.0;
    for number in numbers.iter().take(terms.into()) {
        sum += f64::from((number * inverse) as i32);
    }
    if sum == 0.0 { signed_zero(down) } else { sum * unit }
}

/// `a b + c` of the first three, rounded to odd, with the product cut.
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
