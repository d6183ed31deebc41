//! The operations by name.

use refsim::device::SumRules;
use refsim::num::unit::nv_functions;
use refsim::num::{Env, Format, NumberOperation as Op, Outcome, Rounding, ops, random_word};

use crate::options::one_of::{OneOf, one_of};

/// An operation that the command has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum AluOperation {
    /// An operation of the emulator's table.
    Table(Op),
    RoundToInt,
    Convert,
    /// Converts numbers to a block with a shared scale; `Dequantize` is the reverse.
    Quantize,
    Dequantize,
    /// The sum of any number of products.
    Dot,
    /// `a * b + c`, as the format or device computes it.
    Mad,
    /// A copy.
    Mov,
    /// The clamped reciprocal of the vertex units.
    Rcc,
    /// A comparison that gives one or zero; `true` swaps its operands.
    Set(Op, bool),
    /// An instruction on vectors; a line holds their words.
    Vector(VectorOperation),
}

/// An operation on vectors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum VectorOperation {
    Dp3,
    Dph,
    Dp4,
    Dst,
    Expp,
    Logp,
    Lit,
}

/// The operations, with TestFloat's names if it has them, and their help.
const NAMED: [(AluOperation, &str, &str); 42] = [
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
    (AluOperation::Table(Op::Floor), "floor", "rounded down to a whole number"),
    (AluOperation::Table(Op::Frc), "frc", "a - floor(a)"),
    (AluOperation::Table(Op::Rcp), "rcp", "1 / a"),
    (AluOperation::Table(Op::Rsq), "rsq", "1 / sqrt(a)"),
    (AluOperation::RoundToInt, "roundToInt", "to a whole number, by the rounding of the format"),
    (AluOperation::Convert, "convert", "to the format of --to, rounded by its rules"),
    (AluOperation::Mad, "mad", "a * b + c by the device's rules; in a format, product and sum are each rounded"),
    (AluOperation::Mov, "mov", "a copy"),
    (AluOperation::Set(Op::SetLess, false), "slt", "a < b, as the numbers 1 and 0"),
    (AluOperation::Set(Op::SetLessEqual, true), "sge", "a >= b, likewise"),
    (AluOperation::Set(Op::SetEqual, false), "seq", "a = b, likewise"),
    (AluOperation::Set(Op::SetLess, true), "sgt", "a > b, likewise"),
    (AluOperation::Set(Op::SetLessEqual, false), "sle", "a <= b, likewise"),
    (AluOperation::Set(Op::SetNotEqual, false), "sne", "not a = b, likewise"),
    (AluOperation::Table(Op::Sign), "ssg", "-1, 0 or 1, the sign (vertex units)"),
    (AluOperation::Table(Op::Floor), "flr", "floor"),
    (AluOperation::Rcc, "rcc", "1 / a, clamped to 2^-64 to 2^64 (vertex units)"),
    (AluOperation::Table(Op::Exp2), "ex2", "2^a"),
    (AluOperation::Table(Op::Log2), "lg2", "the logarithm to base 2"),
    (AluOperation::Table(Op::Sin), "sin", "sine, radians"),
    (AluOperation::Table(Op::Cos), "cos", "cosine, radians"),
    (AluOperation::Vector(VectorOperation::Dp3), "dp3", "a.x b.x + a.y b.y + a.z b.z: a, then b, 6 words"),
    (AluOperation::Vector(VectorOperation::Dph), "dph", "dp3 + b.w: a, then b, 8 words"),
    (AluOperation::Vector(VectorOperation::Dp4), "dp4", "the sum of four products: a, then b, 8 words"),
    (AluOperation::Vector(VectorOperation::Dst), "dst", "(1, a.y b.y, a.z, b.w): a, then b, 8 words"),
    (AluOperation::Vector(VectorOperation::Expp), "expp", "EXP of one word: 4 components (vertex units)"),
    (AluOperation::Vector(VectorOperation::Logp), "logp", "LOG of one word: 4 components (vertex units)"),
    (AluOperation::Vector(VectorOperation::Lit), "lit", "lighting of x, y, w: 4 components (vertex units)"),
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

    /// Number of operands, 1 to 3; 0 for operations on lines of any length ([`super::row`]).
    pub(super) const fn operands(self) -> usize {
        match self {
            Self::Table(operation) => operation.operands(),
            Self::RoundToInt | Self::Convert | Self::Mov | Self::Rcc => 1,
            Self::Set(..) => 2,
            Self::Mad => 3,
            // These operations read lines of many numbers: see `super::row`.
            Self::Dot | Self::Quantize | Self::Dequantize | Self::Vector(_) => 0,
        }
    }

    /// Returns `true` if the result is 0 or 1 rather than a number of the format.
    pub(super) const fn is_comparison(self) -> bool {
        matches!(self, Self::Table(Op::Equal | Op::LessEqual | Op::Less))
    }
}

/// An operation in its format.
#[derive(Clone, Copy, Debug)]
pub(super) struct AluUnit {
    pub(super) op: AluOperation,
    /// The format of the operands.
    pub(super) env: Env,
    /// The format of the result: the operands' format, except for `convert`.
    pub(super) to: Format,
    /// The seed of stochastic rounding.
    pub(super) seed: u64,
    /// A device's rules of products and sums.
    pub(super) sums: Option<SumRules>,
}

impl AluUnit {
    /// Width of an operand in bits.
    pub(super) const fn operand_width(&self) -> u32 {
        self.env.format.width()
    }

    /// Width of a result in bits.
    pub(super) const fn result_width(&self) -> u32 {
        if self.op.is_comparison() { 1 } else { self.to.width() }
    }

    /// Returns `true` if a result is a NaN.
    pub(super) const fn is_nan(&self, result: u32) -> bool {
        !self.op.is_comparison() && self.to.is_nan(result)
    }

    /// Returns the result for operands of the format's width; surplus operands are ignored. Stochastic rounding uses
    /// the random word number `index`.
    pub(super) fn evaluate(&self, operands: [u32; 3], index: u64) -> Outcome {
        let (mut env, mut to, [a, b, c]) = (self.env, self.to, operands);
        for format in [&mut env.format, &mut to] {
            if let Rounding::Stochastic(word) = &mut format.rounding {
                *word = random_word(self.seed, index);
            }
        }
        let sums = self.sums.unwrap_or(SumRules::plain(env.format));
        match self.op {
            AluOperation::Table(Op::Add) => sums.add(env, a, b),
            AluOperation::Table(Op::Mul) => sums.mul(env, a, b),
            AluOperation::Mad => sums.mad(env, a, b, c),
            AluOperation::Mov => ops::convert(&env.format, env, a),
            AluOperation::Rcc => Outcome::exact(nv_functions::rcc(a)),
            AluOperation::Set(operation, swapped) => set(env, operation, if swapped { [b, a] } else { [a, b] }),
            AluOperation::Table(operation) => {
                operation.evaluate(env, operands).expect("the table defines what the command names")
            }
            AluOperation::RoundToInt => ops::round_to_int(env, a),
            AluOperation::Dot | AluOperation::Quantize | AluOperation::Dequantize | AluOperation::Vector(_) => {
                unreachable!("`super::row` has the operations on lines of many numbers")
            }
            AluOperation::Convert => ops::convert(&env.format, to.tininess(env.tininess), a),
        }
    }
}

/// A comparison as a number: computed by a card's unit if it has one, otherwise as a quiet comparison.
fn set(env: Env, operation: Op, [a, b]: [u32; 2]) -> Outcome {
    operation.evaluate(env, [a, b, 0]).unwrap_or_else(|| {
        let holds = match operation {
            Op::SetLess => ops::lt_quiet(env, a, b),
            Op::SetLessEqual => ops::le_quiet(env, a, b),
            _ => ops::eq(env, a, b),
        };
        let holds_as = u32::from(operation != Op::SetNotEqual);
        Outcome::new(if holds.bits == holds_as { env.format.one() } else { 0 }, holds.flags)
    })
}
