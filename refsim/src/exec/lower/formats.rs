//! Number formats of a program, and the executors' raw representation of numbers.

use super::graph::Arith;
use super::raw;
use crate::device::Rules;
use crate::exec::FragmentFormats;
use crate::num::{Format, NumberOperation as Op, Overflow};

/// The format of each [`Arith`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Formats([Format; 6]);

impl Formats {
    /// Formats of a pixel program.
    pub(crate) fn pixel(rules: &Rules) -> Self {
        Self::new(rules.format, rules.partial)
    }

    /// Formats of a vertex program.
    pub(crate) fn vertex(format: Format) -> Self {
        Self::new(format, None)
    }

    /// Formats with registers in `main` and `_pp` arithmetic in `partial`.
    fn new(main: Format, partial: Option<Format>) -> Self {
        let FragmentFormats { half, fixed, .. } = FragmentFormats::of_registers(main, partial);
        Self([main, partial.unwrap_or(main), Format::FP32, main.with_overflow(Overflow::Wrap), half, fixed])
    }

    pub(crate) fn format(&self, arith: Arith) -> Format {
        self.0[arith as usize]
    }

    /// All formats, in the order of [`Arith`].
    pub(crate) fn all(&self) -> [Format; 6] {
        self.0
    }

    /// Converts a bit pattern to a raw value.
    pub(crate) fn decode(&self, arith: Arith, bits: u32) -> u32 {
        raw::decode(&self.format(arith), bits)
    }

    /// Converts a raw value to a bit pattern.
    pub(crate) fn encode(&self, arith: Arith, raw: u32) -> u32 {
        raw::encode(&self.format(arith), raw)
    }

    /// Evaluates the comparison `operation` (`a < b`, `a <= b` or `a == b`) on raw values.
    pub(crate) fn compares(&self, arith: Arith, operation: Op, a: u32, b: u32) -> bool {
        let order = if self.format(arith).is_fixed() {
            Some(a.cast_signed().cmp(&b.cast_signed()))
        } else {
            f32::from_bits(a).partial_cmp(&f32::from_bits(b))
        };
        match operation {
            Op::Less => order.is_some_and(|o| o.is_lt()),
            Op::LessEqual => order.is_some_and(|o| o.is_le()),
            _ => order.is_some_and(|o| o.is_eq()),
        }
    }
}
