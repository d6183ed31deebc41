//! Number formats of a program, and the raw representation of numbers in `batch` and `wgsl`.
//!
//! A fixed-point number, normalized or not, is a sign-extended two's complement integer. A float is the binary32
//! pattern of the same number, which exists for every format of registers ([`Format::for_registers`]); NaN is always
//! `0x7fc0_0000`. Formats that the unit of a card computes are stored as its words.

use refsim_lanes::AnyLane;

use super::graph::{Arith, NAMED_FORMATS};
use crate::device::{PRODUCTS, Rules};
use crate::exec::FragmentFormats;
use crate::isa::Program;
use crate::num::{Format, NumberOperation as Op, Overflow};

/// The format of each [`Arith`].
#[derive(Clone, Debug)]
pub(crate) struct Formats(Vec<Format>);

impl Formats {
    pub(crate) fn pixel(program: &Program, rules: &Rules) -> Self {
        let products = rules.accumulator.map(|_| PRODUCTS);
        let stored = rules.storage.iter().map(|(_, format)| format);
        let mut formats =
            Self::new(program, rules.format, rules.partial, stored.chain(rules.accumulator).chain(products));
        // The format in which each of these formats rounds products.
        let rounded: Vec<Format> = formats.0.iter().map(|&format| rules.sums_in(format).products).collect();
        for format in rounded {
            formats.include(format);
        }
        formats
    }

    pub(crate) fn vertex(program: &Program, rules: &Rules) -> Self {
        Self::new(program, rules.vertex_format, None, [])
    }

    /// Creates the formats: registers in `main`, `_pp` arithmetic in `partial`, and the formats of storages and sums.
    fn new(program: &Program, main: Format, partial: Option<Format>, stored: impl IntoIterator<Item = Format>) -> Self {
        let FragmentFormats { half, fixed, .. } = FragmentFormats::of_registers(main, partial);
        let named: [Format; NAMED_FORMATS] =
            [main, partial.unwrap_or(main), Format::FP32, main.with_overflow(Overflow::Wrap), half, fixed];
        let mut formats = Self(named.to_vec());
        for own in program.instructions.iter().filter_map(|i| i.format).chain(stored) {
            formats.include(own);
        }
        formats
    }

    fn include(&mut self, own: Format) {
        if own != self.format(Arith::Main) && !self.own().contains(&own) {
            self.0.push(own);
        }
    }

    /// Formats of single instructions, storages and sums that differ from the registers' formats, each once.
    pub(crate) fn own(&self) -> &[Format] {
        &self.0[NAMED_FORMATS..]
    }

    /// The arithmetic of an instruction or a storage with its own format.
    pub(crate) fn arith_of(&self, own: Format) -> Arith {
        self.own().iter().position(|&f| f == own).map_or(Arith::Main, |index| Arith::Own(index as u8))
    }

    pub(crate) fn format(&self, arith: Arith) -> Format {
        self.0[arith.index()]
    }

    /// All formats, by [`Arith::index`].
    pub(crate) fn all(&self) -> &[Format] {
        &self.0
    }

    /// Returns `true` if a vertex unit of a card computes in one of the formats.
    pub(crate) fn has_vertex_unit(&self) -> bool {
        self.0.iter().any(|format| format.unit.is_vertex_unit())
    }

    /// Converts a bit pattern to a raw value.
    pub(crate) fn decode(&self, arith: Arith, bits: u32) -> u32 {
        AnyLane::new(self.format(arith)).decode(bits)
    }

    /// Evaluates the comparison `operation` (`a < b`, `a <= b` or `a == b`) on raw values.
    pub(crate) fn compares(&self, arith: Arith, operation: Op, a: u32, b: u32) -> bool {
        let format = self.format(arith);
        if format.unit.is_card() {
            return operation.evaluate(format, [a, b, 0]).is_some_and(|outcome| outcome.bits != 0);
        }
        let order = if format.is_fixed() {
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
