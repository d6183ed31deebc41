//! Interprets slots as numbers of the host: floats unchanged, integers in units of their format. The interpretation
//! depends on the kind of format, not on its rules.

use super::row::{LANES, LaneRow};
use super::simd::SimdLevel;

/// Interpretation of a slot's bits as a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reading {
    /// Bits of a host single.
    Float,
    /// Bits of a host single, whose subnormal numbers count as zeros: the word of a card's unit.
    Word,
    /// An integer, in units of `1 / units`.
    Integer {
        /// The code of 1, or the largest code if the format cannot represent 1.
        one: i32,
        /// Units per 1.
        units: f64,
    },
}

impl Reading {
    /// Converts the number to a double: exact, except that a number of a normalized format is rounded to nearest.
    #[inline(always)]
    pub fn to_f64(self, raw: u32) -> f64 {
        match self {
            Self::Float => f64::from(f32::from_bits(raw)),
            Self::Word => f64::from(f32::from_bits(normal(raw))),
            Self::Integer { units, .. } => f64::from(raw.cast_signed()) / units,
        }
    }

    /// Bits of the nearest single; NaN has one pattern.
    #[inline(always)]
    pub fn to_single(self, raw: u32) -> u32 {
        let x = self.to_f64(raw) as f32;
        if x.is_nan() { 0x7fc0_0000 } else { x.to_bits() }
    }

    /// Truncates `scale` times the number clamped to [0, 1] (NaN gives 0), plus `half`.
    ///
    /// Exact for products of 24 by 24 bits, and where the quotient by `units` is an integer.
    #[inline(always)]
    pub fn to_steps(self, raw: u32, scale: f64, half: f64) -> u32 {
        match self {
            // Subnormal magnitudes do not reach one step.
            Self::Float | Self::Word => {
                let x = f64::from(f32::from_bits(raw));
                let low = if x > 0.0 { x } else { 0.0 };
                let clamped = if low < 1.0 { low } else { 1.0 };
                (clamped * scale + half) as u32
            }
            Self::Integer { one, units } => {
                (f64::from(raw.cast_signed().max(0).min(one)) * scale / units + half) as u32
            }
        }
    }

    /// [`Self::to_f64`] for a row.
    pub(crate) fn row_to_f64(self, simd: SimdLevel, row: &LaneRow, out: &mut [f64; LANES]) {
        simd.run(
            #[inline(always)]
            || each(self, row, out, Self::to_f64),
        );
    }

    /// [`Self::to_single`] for a row.
    pub fn row_to_singles(self, simd: SimdLevel, row: &LaneRow, out: &mut LaneRow) {
        simd.run(
            #[inline(always)]
            || each(self, row, out, Self::to_single),
        );
    }

    /// [`Self::to_steps`] for a row.
    pub fn row_to_steps(self, simd: SimdLevel, row: &LaneRow, (scale, half): (f64, f64), out: &mut LaneRow) {
        simd.run(
            #[inline(always)]
            || {
                each(
                    self,
                    row,
                    out,
                    #[inline(always)]
                    |reading, raw| reading.to_steps(raw, scale, half),
                );
            },
        );
    }
}

/// Applies a function to all lanes, in a separate loop for each kind of reading.
#[inline(always)]
fn each<R>(reading: Reading, row: &LaneRow, out: &mut [R; LANES], f: impl Fn(Reading, u32) -> R) {
    match reading {
        Reading::Float => {
            for i in 0..LANES {
                out[i] = f(Reading::Float, row[i]);
            }
        }
        Reading::Word => {
            for i in 0..LANES {
                out[i] = f(Reading::Word, row[i]);
            }
        }
        Reading::Integer { one, units } => {
            for i in 0..LANES {
                out[i] = f(Reading::Integer { one, units }, row[i]);
            }
        }
    }
}

/// The word; a subnormal number becomes a zero of its sign.
#[inline(always)]
fn normal(raw: u32) -> u32 {
    if raw & 0x7f80_0000 == 0 { raw & 1 << 31 } else { raw }
}
