//! The operations by name.

use refsim::num::{Env, Format, NumberOperation as Op, Outcome, Rounding, ops, random_word};

use crate::options::one_of::{OneOf, one_of};

/// An operation that the command has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum AluOperation {
    /// One of the emulator's table.
    Table(Op),
    RoundToInt,
    Convert,
    /// Numbers to a block with a shared scale, and back.
    Quantize,
    Dequantize,
    /// The sum of products of any number.
    Dot,
}

/// The operations under TestFloat's names, where it has one, and what the help says of them.
const NAMED: [(AluOperation, &str, &str); 20] = [
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
    (AluOperation::Dot, "dot", "a b + c d + ... of 1 to 32 pairs, in the format of --accumulator"),
    (AluOperation::Quantize, "quantize", "1 to 32 numbers to a block of --block: scale, then elements"),
    (AluOperation::Dequantize, "dequantize", "a block of --block (scale, then elements) to numbers"),
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

    /// How many operands it takes, 1 to 3; 0 of operations that take lines of any number ([`super::row`]).
    pub(super) const fn operands(self) -> usize {
        match self {
            Self::Table(operation) => operation.operands(),
            Self::RoundToInt | Self::Convert => 1,
            // On lines of many numbers, by `super::row`.
            Self::Dot | Self::Quantize | Self::Dequantize => 0,
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
    /// The seed of stochastic rounding.
    pub(super) seed: u64,
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

    /// The result for operands of the format's width; those that the operation does not take are ignored. Stochastic
    /// rounding takes the word of `index`.
    pub(super) fn evaluate(&self, operands: [u32; 3], index: u64) -> Outcome {
        let (mut env, mut to, [a, ..]) = (self.env, self.to, operands);
        for format in [&mut env.format, &mut to] {
            if let Rounding::Stochastic(word) = &mut format.rounding {
                *word = random_word(self.seed, index);
            }
        }
        match self.op {
            AluOperation::Table(operation) => {
                operation.evaluate(env, operands).expect("the table defines what the command names")
            }
            AluOperation::RoundToInt => ops::round_to_int(env, a),
            AluOperation::Dot | AluOperation::Quantize | AluOperation::Dequantize => {
                unreachable!("`super::row` has the operations on lines of many numbers")
            }
            AluOperation::Convert => ops::convert(&env.format, to.tininess(env.tininess), a),
        }
    }
}
