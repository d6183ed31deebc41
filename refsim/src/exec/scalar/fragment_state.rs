//! State that only OpenGL fragment programs have.

use super::alu::Alu;
use super::registers::{Components, LANES};
use crate::device::Rules;
use crate::exec::FragmentFormats;
use crate::isa::{Condition, ConditionTest, Instruction, Program, RegisterFile};
use crate::num::{Flags, Format, ops};

/// Number of half-precision temporaries.
const HALVES: usize = 64;

/// Condition code: comparison of a result component with zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ConditionCode {
    Less,
    Equal,
    Greater,
    Unordered,
}

impl ConditionCode {
    pub(super) fn of(format: &Format, bits: u32) -> Self {
        if format.is_nan(bits) {
            Self::Unordered
        } else if format.is_zero(bits) {
            Self::Equal
        } else if format.is_negative(bits) {
            Self::Less
        } else {
            Self::Greater
        }
    }

    fn passes(self, test: ConditionTest) -> bool {
        match test {
            ConditionTest::Eq => self == Self::Equal,
            ConditionTest::Ne => self != Self::Equal,
            ConditionTest::Lt => self == Self::Less,
            ConditionTest::Le => matches!(self, Self::Less | Self::Equal),
            ConditionTest::Gt => self == Self::Greater,
            ConditionTest::Ge => matches!(self, Self::Greater | Self::Equal),
            ConditionTest::Tr => true,
            ConditionTest::Fl => false,
        }
    }
}

/// State that only OpenGL fragment programs have, for four lanes. Registers start at zero, condition codes at equal.
pub(super) struct FragmentState<'a> {
    formats: FragmentFormats,
    pub(super) half: Alu<'a>,
    pub(super) fixed: Alu<'a>,
    /// `H#`
    pub(super) halves: [[Components; HALVES]; LANES],
    /// `f[FOGC]`, in full precision.
    pub(super) fog: [Components; LANES],
    /// `f[WPOS]`, in full precision.
    pub(super) position: [Components; LANES],
    /// `o[COLH]`
    pub(super) half_color: [Components; LANES],
    pub(super) codes: [[ConditionCode; 4]; LANES],
}

impl<'a> FragmentState<'a> {
    pub(super) fn new(rules: &'a Rules) -> Self {
        let formats = FragmentFormats::new(rules);
        Self {
            formats,
            half: Alu::new(rules, formats.half),
            fixed: Alu::new(rules, formats.fixed),
            halves: [[[0; 4]; HALVES]; LANES],
            fog: [[0; 4]; LANES],
            position: [[0; 4]; LANES],
            half_color: [[0; 4]; LANES],
            codes: [[ConditionCode::Equal; 4]; LANES],
        }
    }

    pub(super) fn take_flags(&mut self) -> Flags {
        self.half.take_flags() | self.fixed.take_flags()
    }

    /// Final colour of a lane in the register format: `o[COLR]`, passed as `full`, or `o[COLH]`.
    pub(super) fn color(&self, program: &Program, lane: usize, full: Components) -> Components {
        let is_half = |i: &Instruction| i.destination.is_some_and(|d| d.register.file == RegisterFile::HalfColorOut);
        let (from, value) = match program.instructions.iter().any(is_half) {
            true => (self.formats.half, self.half_color[lane]),
            false => (self.formats.full, full),
        };
        value.map(|x| ops::convert(&from, self.formats.full, x).bits)
    }

    pub(super) fn passes(&self, lane: usize, condition: &Condition, component: usize) -> bool {
        self.codes[lane][usize::from(condition.swizzle.0[component] & 3)].passes(condition.test)
    }
}
