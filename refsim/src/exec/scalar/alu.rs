//! Arithmetic in one format under a device's rules: a thin layer over [`crate::num::ops`] that selects the rounding
//! sequence of the profile and collects exception flags.

use crate::device::{AddMode, LrpMode, ResultRange, Rules, SumRules};
use crate::isa::Version;
use crate::num::{self, Flags, Format, NumberOperation, Specials, ops};

/// Operations in `format` under `rules`; accumulates exception flags.
pub(crate) struct Alu<'r> {
    rules: &'r Rules,
    /// `true` if results are clamped to [-1, 1] when written to a register.
    to_one: bool,
    /// Format of the sums of dot products, if different from [`Self::format`].
    accumulator: Option<Format>,
    /// Rules of products and sums.
    sums: SumRules,
    /// Format of operands and results.
    pub(crate) format: Format,
    /// Flags raised since [`Self::take_flags`].
    pub(crate) flags: Flags,
}

/// Wrappers of functions in [`ops`] that use the format of the [`Alu`] and accumulate flags.
macro_rules! operations {
    ($($name:ident($($operand:ident),+) = $definition:path;)*) => {$(
        pub(crate) fn $name(&mut self, $($operand: u32),+) -> u32 {
            self.keep($definition(self.format, $($operand),+))
        }
    )*};
}

impl<'r> Alu<'r> {
    /// Creates pixel arithmetic in `format`.
    pub(crate) fn new(rules: &'r Rules, format: Format) -> Self {
        let to_one = rules.result_range == ResultRange::One;
        let (accumulator, sums) = (rules.accumulator_of(format), rules.sums_in(format));
        Self { rules, to_one, accumulator, sums, format, flags: Flags::empty() }
    }

    /// Creates vertex arithmetic in `format`, without the range, accumulator and sum rules of pixel arithmetic.
    pub(crate) fn vertex(rules: &'r Rules, format: Format) -> Self {
        let sums = SumRules { zero_wins: rules.vertex_zero_times_anything, ..SumRules::plain(format) };
        Self { sums, ..Self::plain(rules, format) }
    }

    /// Creates address arithmetic in `format`, without the legacy rule for zero, and without the range, accumulator and
    /// sum rules of pixel arithmetic.
    pub(crate) fn plain(rules: &'r Rules, format: Format) -> Self {
        let sums = SumRules::plain(format);
        Self { to_one: false, accumulator: None, sums, ..Self::new(rules, format) }
    }

    /// Returns and clears the accumulated flags.
    pub(crate) fn take_flags(&mut self) -> Flags {
        std::mem::replace(&mut self.flags, Flags::empty())
    }

    /// Returns `true` for a card's unit, whose own rules replace the device's.
    pub(crate) fn by_card(&self) -> bool {
        self.format.unit.is_card()
    }

    /// The result of an operation that only units of cards have; `None` if this format's unit lacks it.
    pub(crate) fn card(&mut self, operation: NumberOperation, operands: [u32; 3]) -> Option<u32> {
        let outcome = operation.evaluate(self.format, operands)?;
        Some(self.keep(outcome))
    }

    /// 1 if a comparison holds, else 0. A card's unit has its own operation, which may give NaN.
    pub(crate) fn set(&mut self, operation: NumberOperation, a: u32, b: u32) -> u32 {
        if let Some(result) = self.card(operation, [a, b, 0]) {
            return result;
        }
        let holds = match operation {
            NumberOperation::SetLess => self.less(a, b),
            NumberOperation::SetLessEqual => self.less_or_equal(a, b),
            NumberOperation::SetEqual => self.equal(a, b),
            _ => !self.equal(a, b),
        };
        if holds { self.one() } else { 0 }
    }

    fn keep(&mut self, outcome: num::Outcome) -> u32 {
        self.flags |= outcome.flags;
        outcome.bits
    }

    /// The number 1, or the largest number in formats that cannot represent 1.
    pub(crate) fn one(&self) -> u32 {
        self.format.one()
    }

    /// One half, rounded once.
    pub(crate) fn half(&self) -> u32 {
        num::from_ratio(self.format, false, 1, 2).bits
    }

    /// Converts `bits` from format `from` to this format, rounded once.
    pub(crate) fn enter(&mut self, from: Format, bits: u32) -> u32 {
        if from == self.format {
            return bits;
        }
        self.keep(ops::convert(&from, self.format, bits))
    }

    /// [`Self::enter`] that also canonicalises NaN and flushes subnormals if the formats are equal; for values that did
    /// not result from an operation.
    pub(crate) fn convert(&mut self, from: Format, bits: u32) -> u32 {
        self.keep(ops::convert(&from, self.format, bits))
    }

    /// Converts `bits` from this format to format `to`, rounded once.
    pub(crate) fn leave(&mut self, to: Format, bits: u32) -> u32 {
        if to == self.format {
            return bits;
        }
        self.keep(ops::convert(&self.format, to, bits))
    }

    operations! {
        difference(a, b) = ops::sub;
        div(a, b) = ops::div;
        min(a, b) = ops::min;
        max(a, b) = ops::max;
        neg(a) = ops::neg;
        abs(a) = ops::abs;
        floor(a) = ops::floor;
        frc(a) = ops::frc;
        rcp(a) = ops::rcp;
        rsq(a) = ops::rsq;
        exp2(a) = ops::exp2;
        log2(a) = ops::log2;
        cos(a) = ops::cos;
        sin(a) = ops::sin;
        saturate(a) = ops::saturate01;
        cmp(condition, a, b) = ops::cmp;
        cnd(condition, a, b) = ops::cnd;
    }

    pub(crate) fn add(&mut self, a: u32, b: u32) -> u32 {
        self.keep(self.sums.add(self.format, a, b))
    }

    /// `a - b` for instructions; [`Self::difference`] subtracts neighbouring lanes, which does not use the pixel unit's
    /// adder.
    pub(crate) fn sub(&mut self, a: u32, b: u32) -> u32 {
        match self.sums.add {
            AddMode::Rounded => self.difference(a, b),
            AddMode::Aligned(_) => {
                let negated = self.neg(b);
                self.add(a, negated)
            }
        }
    }

    pub(crate) fn mul(&mut self, a: u32, b: u32) -> u32 {
        self.keep(self.sums.mul(self.format, a, b))
    }

    /// `a * b + c` by the rules, or by a card's unit.
    pub(crate) fn mad(&mut self, a: u32, b: u32, c: u32) -> u32 {
        self.keep(self.sums.mad(self.format, a, b, c))
    }

    /// Dot product of equally long vectors (at most 4 terms), summed in the order and the format given by the rules, or
    /// by a card's unit.
    pub(crate) fn dot(&mut self, a: &[u32], b: &[u32]) -> u32 {
        let n = a.len().min(b.len()).min(4);
        let mut terms = [(0, 0); 4];
        for (term, pair) in terms.iter_mut().zip(a.iter().copied().zip(b.iter().copied())) {
            *term = pair;
        }
        let sums = self.accumulator.map_or(self.sums, |accumulator| self.rules.sums_in(accumulator));
        self.keep(sums.dot(self.format, self.accumulator.unwrap_or(self.format), &terms[..n]))
    }

    /// `_SAT` of OpenGL's programs (GL_NV_fragment_program 3.11.4.4, GL_ARB_fragment_program 3.11.4.3): numbers below 0
    /// become 0, numbers above 1 become 1, and NaN stays.
    pub(crate) fn saturate_number(&mut self, x: u32) -> u32 {
        let stays = self.format.specials == Specials::Ieee && !(self.less(0, x) || self.less_or_equal(x, 0));
        if stays { x } else { self.saturate(x) }
    }

    /// `factor * (a - b) + b`, the last two steps as one [`Self::mad`], or `factor * a + (1 - factor) * b` with each
    /// step rounded.
    pub(crate) fn lrp(&mut self, version: Version, [factor, a, b]: [u32; 3]) -> u32 {
        match self.rules.lrp_in(version) {
            LrpMode::SubMulAdd => {
                let difference = self.sub(a, b);
                self.mad(factor, difference, b)
            }
            LrpMode::TwoProducts => {
                let first = self.mul(factor, a);
                let rest = self.sub(self.one(), factor);
                let second = self.mul(rest, b);
                self.add(first, second)
            }
        }
    }

    /// Rounds a number of format `from` to a storage's format, if it has one, and converts it back.
    pub(crate) fn stored(&mut self, from: Format, storage: Option<Format>, bits: u32) -> u32 {
        let Some(storage) = storage.filter(|storage| *storage != from) else { return bits };
        let narrowed = self.keep(ops::convert(&from, storage, bits));
        self.keep(ops::convert(&storage, from, narrowed))
    }

    /// Multiplies by two to the power `shift`.
    pub(crate) fn scale(&mut self, a: u32, shift: i8) -> u32 {
        if shift == 0 {
            return a;
        }
        self.keep(ops::scale(self.format, a, i32::from(shift)))
    }

    /// Clamps a result to [-1, 1] if the rules require it. A clamp that changes the number counts as an overflow.
    pub(crate) fn in_range(&mut self, a: u32) -> u32 {
        if !self.to_one {
            return a;
        }
        let (one, minus) = (self.one(), ops::neg(self.format, self.one()).bits);
        let below = ops::min(self.format, a, one).bits;
        let clamped = ops::max(self.format, below, minus).bits;
        if clamped != a {
            self.flags |= Flags::OVERFLOW | Flags::INEXACT;
        }
        clamped
    }

    /// `a < b`; false for NaN.
    pub(crate) fn less(&self, a: u32, b: u32) -> bool {
        ops::lt_quiet(self.format, a, b).bits != 0
    }

    /// `a <= b`; false for NaN.
    pub(crate) fn less_or_equal(&self, a: u32, b: u32) -> bool {
        ops::le_quiet(self.format, a, b).bits != 0
    }

    /// `a == b`; false for NaN.
    pub(crate) fn equal(&self, a: u32, b: u32) -> bool {
        ops::eq(self.format, a, b).bits != 0
    }
}
