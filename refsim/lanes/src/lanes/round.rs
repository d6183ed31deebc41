//! Rounding a number of the host into a narrower float format, without branches: the format enters as constants, and
//! one macro serves `f32` and `f64`.

use super::layout::pow2;
use crate::num::{Denormals, Encoding, Format, Overflow, Rounding};

/// The const parameter of the lanes that selects a rounding.
pub(crate) fn rounding_index(rounding: Rounding) -> u8 {
    match rounding {
        Rounding::NearestEven => EVEN,
        Rounding::NearestAway => AWAY,
        // Devices reject stochastic rounding (`Format::for_registers`).
        Rounding::TowardZero | Rounding::Stochastic(_) => ZERO,
        Rounding::Down => DOWN,
        Rounding::Up => UP,
        Rounding::Odd => ODD,
    }
}

pub(crate) const EVEN: u8 = 0;
pub(crate) const AWAY: u8 = 1;
pub(crate) const ZERO: u8 = 2;
pub(crate) const DOWN: u8 = 3;
pub(crate) const UP: u8 = 4;
pub(crate) const ODD: u8 = 5;

macro_rules! rounder {
    ($name:ident, $float:ty, $bits:ty, $mantissa:literal) => {
        /// Rounds numbers of the host into a format.
        #[derive(Clone, Copy, Debug)]
        pub(crate) struct $name {
            /// Exponent bits of the smallest normal number: below it the unit in the last place stays the same.
            lowest: $bits,
            /// Bit pattern of the pivot minus that of the binade's power of two, as integers. The pivot is 1.5 times
            /// the number whose last place is the format's unit.
            pivot: $bits,
            /// The format's unit in the last place, relative to the binade's power of two.
            unit: $float,
            /// Numbers below this become zero: the smallest normal number under [`Denormals::Flush`], else 0.
            flush: $float,
            /// The largest finite number.
            max: $float,
            /// Smallest exact magnitude that becomes infinite, by sign; NaN if no magnitude does.
            infinite: [$float; 2],
            /// Result above the range: infinity, or NaN in encodings without infinity.
            beyond: $float,
        }

        impl $name {
            const SIGN: $bits = 1 << (<$bits>::BITS - 1);
            const EXPONENT: $bits = Self::SIGN - (1 << $mantissa);

            /// Creates the rounder of a format with these field widths.
            pub(crate) fn new(format: &Format, man_bits: u8) -> Self {
                let m = <$bits>::from(man_bits);
                let (emin, emax) = format.exponents();
                let min_normal = pow2(emin) as $float;
                let last = pow2(emax - i32::from(man_bits));
                // The pattern after the largest number is infinity in IEEE 754, NaN in finite formats.
                let short = format.encoding == Encoding::Finite && format.canonical_nan().is_some();
                let exact_max = pow2(emax) * 2.0 - if short { 2.0 } else { 1.0 } * last;
                let max = exact_max as $float;
                let never = <$float>::INFINITY;
                let ieee = format.encoding == Encoding::Ieee;
                let infinite = match (format.overflow, format.rounding) {
                    (_, _) if format.canonical_nan().is_none() => [<$float>::NAN; 2],
                    (Overflow::Saturate, _) if !ieee => [<$float>::NAN; 2],
                    (Overflow::Saturate, _) => [never; 2],
                    (Overflow::Nv30, _) => [(pow2(emax) * 2.0) as $float; 2],
                    (_, Rounding::NearestEven | Rounding::NearestAway) => {
                        let half = (exact_max + last / 2.0) as $float;
                        // If `short`, the largest number is even, so nearest even rounds a tie above it down.
                        let stays = short && format.rounding == Rounding::NearestEven;
                        [<$float>::from_bits(half.to_bits() + <$bits>::from(stays)); 2]
                    }
                    (_, Rounding::TowardZero | Rounding::Odd | Rounding::Stochastic(_)) => [never; 2],
                    (_, Rounding::Down) => [never, <$float>::from_bits(max.to_bits() + 1)],
                    (_, Rounding::Up) => [<$float>::from_bits(max.to_bits() + 1), never],
                };
                Self {
                    lowest: min_normal.to_bits(),
                    pivot: ($mantissa - m) << $mantissa | 1 << ($mantissa - 1),
                    unit: pow2(-i32::from(man_bits)) as $float,
                    flush: if format.denormals == Denormals::Flush { min_normal } else { 0.0 },
                    max,
                    infinite,
                    beyond: if ieee { never } else { <$float>::NAN },
                }
            }

            /// Rounds a number of any size; infinities and NaN are unchanged. The pivot, whose exponent exceeds that of
            /// `x` by the difference of the two mantissa lengths, must be finite.
            #[inline(always)]
            pub(crate) fn round(&self, rounding: u8, x: $float) -> $float {
                let exponent = (x.to_bits() & Self::EXPONENT).max(self.lowest);
                let kept = self.near(rounding, x, exponent);
                self.fit(rounding, x, kept)
            }

            /// All ones for a negative number or `-0`.
            #[inline(always)]
            fn negative(x: $float) -> $bits {
                (x.to_bits() >> (<$bits>::BITS - 1)).wrapping_neg()
            }

            /// The magnitude rounded to the unit of the binade with these exponent bits.
            ///
            /// Adding and subtracting the pivot rounds to nearest even; the other roundings compare the result with the
            /// operand. The pivot of an infinity or a NaN is finite, so these are unchanged.
            #[inline(always)]
            fn near(&self, rounding: u8, x: $float, exponent: $bits) -> $float {
                let pivot = <$float>::from_bits(exponent.wrapping_add(self.pivot));
                let unit = <$float>::from_bits(exponent) * self.unit;
                // Rounding up is rounding the negated number down.
                let value = match rounding {
                    DOWN => x,
                    UP => -x,
                    _ => x.abs(),
                };
                let near = (value + pivot) - pivot;
                let below = (near - if near > value { unit } else { 0.0 }).abs();
                match rounding {
                    EVEN => near,
                    AWAY => near + if value - near >= 0.5 * unit { unit } else { 0.0 },
                    ODD => {
                        let pairs = 0.5 * (below / unit);
                        below + if value > below && pairs == pairs.floor() { unit } else { 0.0 }
                    }
                    _ => below,
                }
            }

            /// Applies the denormal and overflow rules to a rounded magnitude, with the sign of `x`.
            #[inline(always)]
            fn fit(&self, rounding: u8, x: $float, kept: $float) -> $float {
                let kept = if kept < self.flush { 0.0 } else { kept };
                // With these operands of the comparison a NaN is kept.
                let limited = if self.max < kept { self.max } else { kept };
                let by_sign = (self.infinite[0].to_bits() ^ self.infinite[1].to_bits()) & Self::negative(x);
                let differs = if rounding == DOWN || rounding == UP { by_sign } else { 0 };
                let infinite = <$float>::from_bits(self.infinite[0].to_bits() ^ differs);
                let fits = if x.abs() >= infinite { self.beyond } else { limited };
                <$float>::from_bits(fits.to_bits() | x.to_bits() & Self::SIGN)
            }
        }
    };
}

rounder!(SingleRounder, f32, u32, 23);
rounder!(DoubleRounder, f64, u64, 52);

impl SingleRounder {
    /// [`Self::round`] for the roundings other than nearest even. It rounds normal numbers by their bits, without a
    /// pivot.
    #[inline(always)]
    pub(crate) fn cut(&self, rounding: u8, x: f32) -> f32 {
        let size = x.to_bits() & !Self::SIGN;
        let dropped = self.dropped();
        let carry = match rounding {
            AWAY => (dropped >> 1).wrapping_add(1),
            DOWN => Self::negative(x) & dropped,
            _ => 0,
        };
        let normal = f32::from_bits(size.wrapping_add(carry) & !dropped);
        let small = self.near(rounding, x, self.lowest);
        self.fit(rounding, x, if size < self.lowest { small } else { normal })
    }

    /// Mask of the bits that normal numbers of the format lack. (Wrapping arithmetic: an overflow check would be a
    /// branch.)
    #[inline(always)]
    fn dropped(&self) -> u32 {
        1u32.wrapping_shl(self.pivot >> 23).wrapping_sub(1)
    }

    /// Flushes a subnormal number of binary32 to zero if the format does.
    #[inline(always)]
    pub(crate) fn flushed(&self, x: f32) -> f32 {
        let kept = if self.flush == 0.0 { u32::MAX } else { Self::SIGN };
        // No branch: the mask is a constant of the loop, and one bit test decides.
        if x.to_bits() & Self::EXPONENT == 0 { f32::from_bits(x.to_bits() & kept) } else { x }
    }
}

impl DoubleRounder {
    /// Rounds a double into single precision to nearest even by the host's conversion, for the layout of binary32.
    #[inline(always)]
    pub(crate) fn convert(&self, x: f64) -> f32 {
        let (size, max) = (x.abs(), f64::from(f32::MAX));
        let limited = if max < size { max } else { size };
        let fits = if size >= self.infinite[0] { f64::INFINITY } else { limited };
        f64::from_bits(fits.to_bits() | x.to_bits() & Self::SIGN) as f32
    }
}

/// Rounds singles into a format of at most eleven bits and six exponent bits, in roundings other than nearest even.
/// Subnormal numbers are kept, and magnitudes above the range become infinite.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShortRounder {
    /// Exponent bits of the smallest normal number, and of the power of two above the range.
    binades: [u32; 2],
    /// This minus the exponent bits of a binade is the bit pattern of 1 / (unit of the binade).
    per_unit: u32,
    /// This plus the exponent bits of a binade is the bit pattern of the binade's unit, scaled so that numbers that are
    /// too large for the format overflow in the host's `f32` too.
    unit: u32,
    /// Undoes the scaling.
    shrink: f32,
}

impl ShortRounder {
    /// Creates the rounder of a format with these field widths.
    pub(crate) fn new(exp_bits: u8, man_bits: u8) -> Self {
        const BIAS: u32 = 127;
        let (m, emax) = (u32::from(man_bits), (1 << (exp_bits - 1)) - 1);
        Self {
            binades: [(BIAS + 1).wrapping_sub(emax) << 23, (BIAS + 1 + emax) << 23],
            per_unit: (2 * BIAS + m) << 23,
            unit: BIAS.wrapping_sub(emax).wrapping_sub(m) << 23,
            shrink: pow2(emax.cast_signed() - 127) as f32,
        }
    }

    /// Rounds a result of an operation on numbers of the format; infinities and NaN are unchanged.
    ///
    /// The number is scaled to eleven bits before the point, where the host rounds it to an integer in the requested
    /// direction. Adding half a unit is exact enough: numbers below a unit are products, which have 22 bits.
    #[inline(always)]
    pub(crate) fn round(&self, rounding: u8, x: f32) -> f32 {
        let [lowest, highest] = self.binades;
        let binade = (x.to_bits() & 0x7f80_0000).max(lowest).min(highest);
        let units = x * f32::from_bits(self.per_unit.wrapping_sub(binade));
        let whole = match rounding {
            AWAY => (units + 0.5_f32.copysign(units)).trunc(),
            DOWN => units.floor(),
            _ => units.trunc(),
        };
        whole * f32::from_bits(binade.wrapping_add(self.unit)) * self.shrink
    }
}
