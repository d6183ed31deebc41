//! The operations by name.

use refsim::num::{Env, Format, NumberOperation as Op, Outcome, ops};

use crate::cli::one_of::{OneOf, one_of};

/// An operation that the command has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum AluOperation {
    /// One of the emulator's table.
    Table(Op),
    RoundToInt,
    Convert,
}

/// The operations under TestFloat's names, where it has one, and what the help says of them.
const NAMED: [(AluOperation, &str, &str); 17] = [
    (AluOperation::Table(Op::Add), "add", "two operands, rounded once"),
    (AluOperation::Table(Op::Sub), "sub", "two operands, rounded once"),
    (AluOperation::Table(Op::Mul), "mul", "two operands, rounded once"),
    (AluOperation::Table(Op::Div), "div", "two operands, rounded once"),
    (AluOperation::Table(Op::Sqrt), "sqrt", "square root"),
    (AluOperation::Table(Op::FusedMad), "mulAdd", "a * b + c, fused: rounded once"),
    (AluOperation::Table(Op::Equal), "eq", "a = b, as 0 or 1; quiet"),
    (AluOperation::Table(Op::LessEqual), "le", "a <= b, as 0 or 1; any NaN is invalid"),
    (AluOperation::Table(Op::Less), "lt", "a < b, as 0 or 1; any NaN is invalid"),
    (AluOperation::Table(Op::Min), "min", "the lesser"),
    (AluOperation::Table(Op::Max), "max", "the greater"),
    (AluOperation::Table(Op::Floor), "floor", "the next whole number below"),
    (AluOperation::Table(Op::Frc), "frc", "a - floor(a)"),
    (AluOperation::Table(Op::Rcp), "rcp", "1 / a"),
    (AluOperation::Table(Op::Rsq), "rsq", "1 / sqrt(a)"),
    (AluOperation::RoundToInt, "roundToInt", "to a whole number, by the rounding of the format"),
    (AluOperation::Convert, "convert", "to the format of --to, rounded by its rules"),
];

impl AluOperation {
    /// Parses an operation by its name.
    pub(super) fn parser() -> OneOf<Self> {
        one_of(NAMED.map(|(operation, name, help)| (name, help, operation)))
    }

    /// The name on the command line.
    pub(super) fn name(self) -> &'static str {
        NAMED.iter().find(|(operation, ..)| *operation == self).map_or("", |&(_, name, _)| name)
    }

    /// How many operands it takes, 1 to 3.
    pub(super) const fn operands(self) -> usize {
        match self {
            Self::Table(operation) => operation.operands(),
            Self::RoundToInt | Self::Convert => 1,
        }
    }

    /// Returns `true` if the result is 0 or 1 instead of a number of the format.
    pub(super) const fn is_comparison(self) -> bool {
        matches!(self, Self::Table(Op::Equal | Op::LessEqual | Op::Less))
    }
}

/// An operation in its format.
#[derive(Clone, Copy, Debug)]
pub(super) struct Unit {
    pub(super) op: AluOperation,
    /// The format of the operands.
    pub(super) env: Env,
    /// The format of the result (that of the operands, but for `convert`).
    pub(super) to: Format,
    /// True if `roundToInt` raises inexact.
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

    /// Returns `true` if a result is a NaN.
    pub(super) const fn is_nan(&self, result: u32) -> bool {
        !self.op.is_comparison() && self.to.is_nan(result)
    }

    /// The result for operands of the format's width; those that the operation does not take are ignored.
    pub(super) fn evaluate(&self, operands: [u32; 3]) -> Outcome {
        let (env, [a, ..]) = (self.env, operands);
        match self.op {
            AluOperation::Table(operation) => {
                operation.evaluate(env, operands).expect("the table defines what the command names")
            }
            AluOperation::RoundToInt if self.exact => ops::round_to_int_exact(env, a),
            AluOperation::RoundToInt => ops::round_to_int(env, a),
            AluOperation::Convert => ops::convert(&env.format, self.to.tininess(env.tininess), a),
        }
    }
}
