//! A card's unit as the arithmetic of a format.

use std::fmt::Debug;

use super::word::{Met, NAN, ONE, SIGN, flushed, mask};
use crate::lanes::float::GeneralLane;
use crate::lanes::lane::Lane;
use crate::lanes::lane::apply;
use crate::lanes::reading::Reading;
use crate::num::{Format, FormatKind, NumberOperation as Op, Unit as Name};

const HALF: u32 = 0x3f00_0000;

/// Functions of a unit besides sums, products, comparisons and integral parts.
pub(crate) trait CardFunctions {
    /// Numbers of a table. They are looked up in a separate loop, because lookups prevent vectorization.
    type Entry: Copy;
    /// Table entry for RCP of `x`.
    fn rcp_entry(&self, x: u32) -> Self::Entry;
    fn rcp(&self, x: u32, entry: Self::Entry) -> u32;
    /// Table entry for RSQ of `x`.
    fn rsq_entry(&self, x: u32) -> Self::Entry;
    fn rsq(&self, x: u32, entry: Self::Entry) -> u32;
    /// Any other operation; `None` if the unit lacks it.
    fn function(&self, operation: Op, operands: [u32; 3]) -> Option<u32>;
}

/// Operations that differ between units. The `quick_` versions are vectorized: they also return the range of magnitudes
/// encountered, which shows whether the result may be wrong. `FUSED` is `true` if the host has fused multiply-add.
pub(crate) trait CardUnit: CardFunctions + Copy + Send + Sync + Debug {
    /// True if comparisons return NaN for unordered words.
    const SETS_NAN: bool;

    fn new(format: &Format) -> Self;

    fn mul(&self, a: u32, b: u32) -> u32;
    /// The sum of `N` products, 1 to 4, by the unit's rules.
    fn dot<const N: usize>(&self, a: [u32; N], b: [u32; N]) -> u32;
    fn add(&self, a: u32, b: u32) -> u32;
    fn mad(&self, a: u32, b: u32, c: u32) -> u32;

    /// [`Self::add`] in vector code.
    fn quick_add(&self, a: u32, b: u32) -> (u32, Met);
    /// [`Self::mul`] in vector code.
    fn quick_mul<const FUSED: bool>(&self, a: u32, b: u32) -> (u32, Met);
    /// [`Self::mad`] in vector code.
    fn quick_mad<const FUSED: bool>(&self, a: u32, b: u32, c: u32) -> (u32, Met);
    /// [`Self::dot`] in vector code.
    fn quick_dot<const FUSED: bool, const N: usize>(&self, a: [u32; N], b: [u32; N]) -> (u32, Met);

    /// Returns `true` if one of two words is an unordered NaN. Branch-free, like the methods below.
    fn unordered(&self, a: u32, b: u32) -> bool;
    /// `a < b` of ordered words.
    fn below(&self, a: u32, b: u32) -> bool;
    /// `a == b` of ordered words.
    fn same(&self, a: u32, b: u32) -> bool;
    fn min(&self, a: u32, b: u32) -> u32;
    fn max(&self, a: u32, b: u32) -> u32;
    /// The largest integer not above `x`.
    fn floor(&self, x: u32) -> u32;
    /// `x` clamped to [0, 1].
    fn saturate(&self, x: u32) -> u32;
}

/// The arithmetic of a unit. Operations that the unit lacks are computed in the ideal format, with the unit's NaN.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CardLane<U> {
    pub(crate) unit: U,
    ideal: GeneralLane,
}

impl<U: CardUnit> CardLane<U> {
    /// The arithmetic of a format whose unit is `U`.
    pub(crate) fn new(format: &Format) -> Self {
        let (exp_bits, man_bits) = match format.kind {
            FormatKind::Float { exp_bits, man_bits } => (exp_bits, man_bits),
            _ => (8, 23),
        };
        Self { unit: U::new(format), ideal: GeneralLane::new(&format.with_unit(Name::Ideal), exp_bits, man_bits) }
    }

    fn of_ideal(x: f32) -> u32 {
        if x.is_nan() { NAN } else { x.to_bits() }
    }

    /// Computes an operation on words; comparisons return masks. `None` for operations that lanes do not implement.
    pub(crate) fn word(&self, operation: Op, [a, b, c]: [u32; 3]) -> Option<u32> {
        let unit = &self.unit;
        Some(match operation {
            Op::Add => unit.add(a, b),
            Op::Sub => unit.add(a, b ^ SIGN),
            Op::Mul => unit.mul(a, b),
            Op::Mad | Op::FusedMad => unit.mad(a, b, c),
            Op::Min => unit.min(a, b),
            Op::Max => unit.max(a, b),
            Op::Floor => unit.floor(a),
            Op::Frc => unit.add(a, unit.floor(a) ^ SIGN),
            Op::Saturate => unit.saturate(a),
            Op::Rcp => unit.rcp(a, unit.rcp_entry(a)),
            Op::Rsq => unit.rsq(a, unit.rsq_entry(a)),
            Op::Neg => a ^ SIGN,
            Op::Abs => a & !SIGN,
            Op::Less => mask(self.less(a, b)),
            Op::LessEqual => mask(self.less_equal(a, b)),
            Op::Equal => mask(self.equal(a, b)),
            Op::SetLess => self.flag(a, b, self.less(a, b)),
            Op::SetLessEqual => self.flag(a, b, self.less_equal(a, b)),
            Op::SetEqual => self.flag(a, b, self.equal(a, b)),
            Op::SetNotEqual => self.flag(a, b, !self.equal(a, b)),
            Op::SelectNonNegative => self.select_non_negative(a, b, c),
            Op::SelectAboveHalf => {
                if self.less(HALF, a) {
                    b
                } else {
                    c
                }
            }
            _ => return unit.function(operation, [a, b, c]).or_else(|| self.otherwise(operation, [a, b, c])),
        })
    }

    /// Computes an operation that every arithmetic has; the result is a number.
    fn number<const N: usize>(&self, operation: Op, operands: [i32; N]) -> i32 {
        let mut words = [0; 3];
        words[..N].copy_from_slice(&operands.map(i32::cast_unsigned));
        self.word(operation, words).unwrap_or(NAN).cast_signed()
    }

    /// Computes an operation that the unit does not have.
    fn otherwise(&self, operation: Op, words: [u32; 3]) -> Option<u32> {
        let operands = words.map(|word| self.ideal.decode(word));
        let value = match operation {
            Op::Scale => self.ideal.scale(operands[0], words[1].cast_signed()),
            _ => apply(&self.ideal, operation, operands)?,
        };
        Some(Self::of_ideal(value))
    }

    /// Result of a comparison: 1 or +0; unordered operands give NaN on units that define one.
    #[inline(always)]
    pub(crate) fn flag(&self, a: u32, b: u32, holds: bool) -> u32 {
        let word = if holds { ONE } else { 0 };
        if U::SETS_NAN & self.unit.unordered(a, b) { NAN } else { word }
    }

    /// `a < b`; false for unordered words.
    #[inline(always)]
    pub(crate) fn less(&self, a: u32, b: u32) -> bool {
        !self.unit.unordered(a, b) & self.unit.below(a, b)
    }

    /// `a <= b`; false for unordered words.
    #[inline(always)]
    pub(crate) fn less_equal(&self, a: u32, b: u32) -> bool {
        !self.unit.unordered(a, b) & !self.unit.below(b, a)
    }

    /// `b` if `a` is not below zero, else `c`.
    #[inline(always)]
    pub(crate) fn select_non_negative(&self, a: u32, b: u32, c: u32) -> u32 {
        if self.less_equal(0, a) { b } else { c }
    }

    /// `a == b`; false for unordered words.
    #[inline(always)]
    pub(crate) fn equal(&self, a: u32, b: u32) -> bool {
        !self.unit.unordered(a, b) & self.unit.same(a, b)
    }
}

/// Operations of lanes that are operations on words.
macro_rules! by_word {
    ($($name:ident($a:ident $(, $more:ident)*) = $operation:ident;)*) => {
        $(fn $name(&self, $a: i32 $(, $more: i32)*) -> i32 {
            self.number(Op::$operation, [$a $(, $more)*])
        })*
    };
}

/// Numbers in slots are words, held as integers.
impl<U: CardUnit> Lane for CardLane<U> {
    type T = i32;
    type General = GeneralLane;

    const CARD: bool = true;

    #[inline(always)]
    fn decode(&self, bits: u32) -> i32 {
        bits.cast_signed()
    }

    #[inline(always)]
    fn encode(&self, x: i32) -> u32 {
        x.cast_unsigned()
    }

    #[inline(always)]
    fn to_f64(&self, x: i32) -> f64 {
        f64::from(f32::from_bits(flushed(x.cast_unsigned())))
    }

    fn reading(&self) -> Reading {
        Reading::Word
    }

    #[inline(always)]
    fn round_f64(&self, x: f64) -> i32 {
        Self::of_ideal(self.ideal.round_f64(x)).cast_signed()
    }

    fn exact_dot<const N: usize>(&self, a: [i32; N], b: [i32; N]) -> i32 {
        self.unit.dot(a.map(i32::cast_unsigned), b.map(i32::cast_unsigned)).cast_signed()
    }

    by_word! {
        add(a, b) = Add;
        mul(a, b) = Mul;
        fused_mad(a, b, c) = Mad;
        div(a, b) = Div;
        sqrt(a) = Sqrt;
        rcp(a) = Rcp;
        rsq(a) = Rsq;
        exp2(a) = Exp2;
        log2(a) = Log2;
        min(a, b) = Min;
        max(a, b) = Max;
        frc(a) = Frc;
        neg(a) = Neg;
        abs(a) = Abs;
        saturate(a) = Saturate;
    }

    fn above_half(&self, a: i32) -> bool {
        self.to_f64(a) > 0.5
    }
}
