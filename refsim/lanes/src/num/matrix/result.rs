//! The last step of a unit: an exact sum as a word.

use num_bigint::{BigInt, Sign};
use num_traits::ToPrimitive as _;

use super::element::{Element, Value};
use crate::num::aligned::Addend;

/// Format and rounding of results.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ResultFormat {
    /// Single precision, cut; never -0. `2^128` and more is infinity.
    Cut32,
    /// Single precision, cut to 13 bits of fraction; the low ten bits of the word are zero. Never -0.
    Cut22,
    /// Half precision, to nearest even; never -0. 65520 and more is infinity.
    Nearest16,
    /// Single precision, to nearest even. A result that rounds to zero keeps its sign.
    Nearest32,
    /// Double precision, to nearest even. What rounds to zero keeps its sign.
    Nearest64,
}

impl ResultFormat {
    /// Type of the word.
    pub const fn element(self) -> Element {
        match self {
            Self::Cut32 | Self::Cut22 | Self::Nearest32 => Element::FP32,
            Self::Nearest16 => Element::FP16,
            Self::Nearest64 => Element::FP64,
        }
    }

    /// Name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Cut32 => "fp32, cut",
            Self::Cut22 => "e8m13, cut",
            Self::Nearest16 => "fp16, to nearest",
            Self::Nearest32 => "fp32, to nearest",
            Self::Nearest64 => "fp64, to nearest",
        }
    }

    /// Returns `true` for the results of NVIDIA's adders.
    pub(super) const fn is_nvidia(self) -> bool {
        matches!(self, Self::Cut32 | Self::Cut22 | Self::Nearest16)
    }

    /// The word of an infinity or a NaN. NVIDIA's NaN is 7fffffff or 7fff; which bits others give is not known: theirs
    /// is the positive quiet one.
    pub(super) fn special(self, value: Value) -> u64 {
        let element = self.element();
        match value {
            Value::Infinite { negative } => element.infinity() | u64::from(negative) << (element.width() - 1),
            _ if self.is_nvidia() => (1 << (element.width() - 1)) - 1,
            _ => element.infinity() | 1 << (element.fraction_bits - 1),
        }
    }

    /// The word of `(-1)^negative * magnitude * 2^exponent`, rounded once; the magnitude is below `2^121`. An exact
    /// zero is +0.
    pub(super) fn round(self, negative: bool, magnitude: u128, exponent: i32) -> u64 {
        if magnitude == 0 {
            return 0;
        }
        let element = self.element();
        let kept_bits = if self == Self::Cut22 { 13 } else { element.fraction_bits };
        let top = (magnitude.ilog2().cast_signed() + exponent).max(element.least_exponent());
        let dropped = top - kept_bits.cast_signed() - exponent;
        let is_cut = matches!(self, Self::Cut32 | Self::Cut22);
        let kept = match dropped {
            ..=0 => magnitude << dropped.unsigned_abs(),
            1..=122 => {
                let (kept, rest, half) =
                    (magnitude >> dropped, magnitude & ((1 << dropped) - 1), 1_u128 << (dropped - 1));
                let is_up = !is_cut && (rest > half || rest == half && kept & 1 == 1);
                kept + u128::from(is_up)
            }
            _ => 0,
        };
        // The leading bit of normal numbers counts one in the exponent field.
        let word = ((top - element.least_exponent()) as u64) << kept_bits;
        let word = (word + kept as u64) << (element.fraction_bits - kept_bits);
        if word == 0 && self.is_nvidia() {
            return 0;
        }
        word.min(element.infinity()) | u64::from(negative) << (element.width() - 1)
    }
}

/// An exact sum of terms `(-1)^negative * magnitude * 2^exponent`: sign, magnitude below `2^121` whose last bit
/// includes all bits below it, exponent.
pub(super) fn exact_sum(terms: &[(bool, u128, i32)]) -> (bool, u128, i32) {
    let least = terms.iter().map(|term| term.2).min().unwrap_or(0);
    let shifted = |&(negative, magnitude, exponent): &(bool, u128, i32)| {
        let magnitude = BigInt::from(magnitude) << (exponent - least).unsigned_abs();
        if negative { -magnitude } else { magnitude }
    };
    let sum: BigInt = terms.iter().map(shifted).sum();
    let dropped = sum.bits().saturating_sub(120);
    let magnitude = sum.magnitude() >> dropped;
    let is_inexact = sum.magnitude().trailing_zeros().is_some_and(|zeros| zeros < dropped);
    let magnitude = magnitude.to_u128().unwrap_or(0) | u128::from(is_inexact);
    (sum.sign() == Sign::Minus, magnitude, least + dropped as i32)
}

/// An addend as a term of [`exact_sum`].
pub(super) fn term(addend: Addend) -> (bool, u128, i32) {
    (addend.negative, addend.magnitude.into(), addend.exponent - addend.fraction.cast_signed())
}
