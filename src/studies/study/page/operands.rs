//! Operands of the table of operations, from a counter-based generator that the page's script repeats.

use refsim::num::{Format, FormatKind};
use serde::Serialize;

/// Bits of a format's patterns, as the generator uses them.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct PatternBits {
    sign: u32,
    /// Exponent field, or integer bits.
    high: u32,
    /// Mantissa field, or fraction bits.
    low: u32,
    /// Bits in which an operand may differ from the previous one.
    near: u32,
    /// Lowest bit of the exponent field.
    shift: u32,
    /// Exponent field of 1/8, from which eight exponents are drawn; 0 in fixed point.
    middle: u32,
}

impl PatternBits {
    pub(super) fn new(format: &Format) -> Self {
        let ones = |bits: u8| (1_u32 << bits) - 1;
        let (upper, lower) = match format.kind {
            FormatKind::Fixed { int_bits, frac_bits } | FormatKind::Normalized { int_bits, frac_bits } => {
                (int_bits, frac_bits)
            }
            FormatKind::Float { exp_bits, man_bits } => (exp_bits, man_bits),
        };
        let (high, low) = (ones(upper) << lower, ones(lower));
        let sign = 1 << (upper + lower);
        let float = !format.is_fixed();
        let near = if float { low | 3 << lower } else { low };
        let middle = if float { ones(upper - 1).saturating_sub(4) } else { 0 };
        Self { sign, high, low, near, shift: lower.into(), middle }
    }

    /// Operand `k` of a set, derived from the set's counter and the previous operand.
    fn operand(&self, counter: u32, k: u32, before: u32) -> u32 {
        let random = mixed(counter.wrapping_mul(4).wrapping_add(k));
        let choice = mixed(random ^ 0x9e37_79b9);
        let bits = random & (self.sign | self.high | self.low);
        match choice & 15 {
            0 => bits & !self.low,
            1 => bits | self.low,
            2 => bits & !self.high,
            3 => bits | self.high,
            4 => bits & self.sign,
            5 => bits | self.high | self.low,
            6 => bits & self.sign | self.high,
            7 => bits & self.sign | 1,
            8..=11 if k > 0 => before ^ bits & self.near,
            12 | 13 if self.middle > 0 => bits & !self.high | (self.middle + (choice >> 8 & 7)) << self.shift,
            _ => bits,
        }
    }

    pub(super) fn set(&self, counter: u32) -> [u32; 3] {
        let a = self.operand(counter, 0, 0);
        let b = self.operand(counter, 1, a);
        [a, b, self.operand(counter, 2, b)]
    }
}

/// The PCG RXS-M-XS permutation of a word, after one step of its congruential generator (O'Neill, 2014).
const fn mixed(word: u32) -> u32 {
    let state = word.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let permuted = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    permuted >> 22 ^ permuted
}
