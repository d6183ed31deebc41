//! The operations by name.

use clap::{ValueEnum, builder::PossibleValue};
use refsim::num::{Env, Format, Outcome, ops};

/// An operation, under TestFloat's name where it has one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Operation {
    Add,
    Sub,
    Mul,
    Div,
    Sqrt,
    MulAdd,
    Eq,
    Le,
    Lt,
    Min,
    Max,
    Floor,
    Frc,
    Rcp,
    Rsq,
    RoundToInt,
    Convert,
}

impl Operation {
    const ALL: [Self; 17] = [
        Self::Add,
        Self::Sub,
        Self::Mul,
        Self::Div,
        Self::Sqrt,
        Self::MulAdd,
        Self::Eq,
        Self::Le,
        Self::Lt,
        Self::Min,
        Self::Max,
        Self::Floor,
        Self::Frc,
        Self::Rcp,
        Self::Rsq,
        Self::RoundToInt,
        Self::Convert,
    ];

    /// The name on the command line.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Add => "add",
            Self::Sub => "sub",
            Self::Mul => "mul",
            Self::Div => "div",
            Self::Sqrt => "sqrt",
            Self::MulAdd => "mulAdd",
            Self::Eq => "eq",
            Self::Le => "le",
            Self::Lt => "lt",
            Self::Min => "min",
            Self::Max => "max",
            Self::Floor => "floor",
            Self::Frc => "frc",
            Self::Rcp => "rcp",
            Self::Rsq => "rsq",
            Self::RoundToInt => "roundToInt",
            Self::Convert => "convert",
        }
    }

    /// How many operands it takes, 1 to 3.
    pub(super) const fn operands(self) -> usize {
        match self {
            Self::MulAdd => 3,
            Self::Add | Self::Sub | Self::Mul | Self::Div | Self::Eq | Self::Le | Self::Lt | Self::Min | Self::Max => 2,
            Self::Sqrt | Self::Floor | Self::Frc | Self::Rcp | Self::Rsq | Self::RoundToInt | Self::Convert => 1,
        }
    }

    /// Whether the result is 0 or 1 instead of a number of the format.
    pub(super) const fn is_comparison(self) -> bool {
        matches!(self, Self::Eq | Self::Le | Self::Lt)
    }
}

impl ValueEnum for Operation {
    fn value_variants<'a>() -> &'a [Self] {
        &Self::ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        let help = match self {
            Self::Add | Self::Sub | Self::Mul | Self::Div => "two operands, rounded once",
            Self::Sqrt => "square root",
            Self::MulAdd => "a * b + c, fused: rounded once",
            Self::Eq => "a = b, as 0 or 1; quiet",
            Self::Le => "a <= b, as 0 or 1; any NaN is invalid",
            Self::Lt => "a < b, as 0 or 1; any NaN is invalid",
            Self::Min => "the lesser",
            Self::Max => "the greater",
            Self::Floor => "the next whole number below",
            Self::Frc => "a - floor(a)",
            Self::Rcp => "1 / a",
            Self::Rsq => "1 / sqrt(a)",
            Self::RoundToInt => "to a whole number, by the rounding of the format",
            Self::Convert => "to the format of --to, rounded by its rules",
        };
        Some(PossibleValue::new(self.name()).help(help))
    }
}

/// An operation in its format.
#[derive(Clone, Copy, Debug)]
pub(super) struct Unit {
    pub(super) op: Operation,
    /// The format of the operands.
    pub(super) env: Env,
    /// The format of the result (that of the operands, but for `convert`).
    pub(super) to: Format,
    /// Whether `roundToInt` raises inexact.
    pub(super) exact: bool,
}

impl Unit {
    /// Bits of an operand.
    pub(super) const fn operand_width(&self) -> u32 {
        self.env.format.width()
    }

    /// Bits of a result.
    pub(super) const fn result_width(&self) -> u32 {
        if self.op.is_comparison() { 1 } else { self.to.width() }
    }

    /// Whether a result is a NaN.
    pub(super) const fn is_nan(&self, result: u32) -> bool {
        !self.op.is_comparison() && self.to.is_nan(result)
    }

    /// The result for operands of the format's width; those that the operation does not take are ignored.
    pub(super) fn evaluate(&self, [a, b, c]: [u32; 3]) -> Outcome {
        let env = self.env;
        match self.op {
            Operation::Add => ops::add(env, a, b),
            Operation::Sub => ops::sub(env, a, b),
            Operation::Mul => ops::mul(env, a, b),
            Operation::Div => ops::div(env, a, b),
            Operation::Sqrt => ops::sqrt(env, a),
            Operation::MulAdd => ops::fused_mad(env, a, b, c),
            Operation::Eq => ops::eq(env, a, b),
            Operation::Le => ops::le(env, a, b),
            Operation::Lt => ops::lt(env, a, b),
            Operation::Min => ops::min(env, a, b),
            Operation::Max => ops::max(env, a, b),
            Operation::Floor => ops::floor(env, a),
            Operation::Frc => ops::frc(env, a),
            Operation::Rcp => ops::rcp(env, a),
            Operation::Rsq => ops::rsq(env, a),
            Operation::RoundToInt if self.exact => ops::round_to_int_exact(env, a),
            Operation::RoundToInt => ops::round_to_int(env, a),
            Operation::Convert => ops::convert(&env.format, self.to.tininess(env.tininess), a),
        }
    }
}
