//! The operations by name.

use std::ops::RangeInclusive;

use refsim::device::SumRules;
use refsim::num::block::{BLOCK, BlockFormat};
use refsim::num::unit::nv_functions;
use refsim::num::{DotOrder, Env, Format, NumberOperation as Op, Outcome, Rounding, ops, random_word};

use crate::options::one_of::{OneOf, one_of};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum AluOperation {
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
    Mov,
    /// The clamped reciprocal of the vertex units.
    Rcc,
    /// `true` swaps the operands.
    Set(Op, bool),
    // Instructions on vectors: a line holds the components of a, then those of b.
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
    (AluOperation::Table(Op::Add), "add", "a + b, rounded once"),
    (AluOperation::Table(Op::Sub), "sub", "a - b, rounded once"),
    (AluOperation::Table(Op::Mul), "mul", "a * b, rounded once"),
    (AluOperation::Table(Op::Div), "div", "a / b, rounded once"),
    (AluOperation::Table(Op::Sqrt), "sqrt", "square root"),
    (AluOperation::Table(Op::FusedMad), "mulAdd", "a * b + c, fused: rounded once"),
    (AluOperation::Table(Op::Equal), "eq", "a = b, as 0 or 1; only a signalling NaN is invalid"),
    (AluOperation::Table(Op::LessEqual), "le", "a <= b, as 0 or 1; any NaN is invalid"),
    (AluOperation::Table(Op::Less), "lt", "a < b, as 0 or 1; any NaN is invalid"),
    (AluOperation::Table(Op::Min), "min", "the smaller operand"),
    (AluOperation::Table(Op::Max), "max", "the larger operand"),
    (AluOperation::Table(Op::Floor), "floor", "rounded down to a whole number"),
    (AluOperation::Table(Op::Frc), "frc", "a - floor(a)"),
    (AluOperation::Table(Op::Rcp), "rcp", "1 / a"),
    (AluOperation::Table(Op::Rsq), "rsq", "1 / sqrt(a)"),
    (AluOperation::RoundToInt, "roundToInt", "rounded to a whole number, with the rounding of the format"),
    (AluOperation::Convert, "convert", "converted to the format of --to, with its rounding"),
    (
        AluOperation::Mad,
        "mad",
        "a * b + c; with --device by the device's rules, with --format rounded after the product and again after the sum",
    ),
    (AluOperation::Mov, "mov", "a copy"),
    (AluOperation::Set(Op::SetLess, false), "slt", "a < b, as the numbers 1 and 0"),
    (AluOperation::Set(Op::SetLessEqual, true), "sge", "a >= b, as the numbers 1 and 0"),
    (AluOperation::Set(Op::SetEqual, false), "seq", "a = b, as the numbers 1 and 0"),
    (AluOperation::Set(Op::SetLess, true), "sgt", "a > b, as the numbers 1 and 0"),
    (AluOperation::Set(Op::SetLessEqual, false), "sle", "a <= b, as the numbers 1 and 0"),
    (AluOperation::Set(Op::SetNotEqual, false), "sne", "not a = b, as the numbers 1 and 0"),
    (AluOperation::Table(Op::Sign), "ssg", "-1, 0 or 1, the sign (vertex units)"),
    (AluOperation::Table(Op::Floor), "flr", "floor"),
    (AluOperation::Rcc, "rcc", "1 / a, clamped to 2^-64 to 2^64 (vertex units)"),
    (AluOperation::Table(Op::Exp2), "ex2", "2^a"),
    (AluOperation::Table(Op::Log2), "lg2", "the logarithm to base 2"),
    (AluOperation::Table(Op::Sin), "sin", "sine, radians"),
    (AluOperation::Table(Op::Cos), "cos", "cosine, radians"),
    (AluOperation::Dp3, "dp3", "a.x b.x + a.y b.y + a.z b.z: a, then b, 6 words"),
    (AluOperation::Dph, "dph", "dp3 + b.w: a, then b, 8 words"),
    (AluOperation::Dp4, "dp4", "the sum of four products: a, then b, 8 words"),
    (AluOperation::Dst, "dst", "(1, a.y b.y, a.z, b.w): a, then b, 8 words"),
    (AluOperation::Expp, "expp", "EXP of one word: 4 components (vertex units)"),
    (AluOperation::Logp, "logp", "LOG of one word: 4 components (vertex units)"),
    (AluOperation::Lit, "lit", "lighting of x, y, w: 4 components (vertex units)"),
    (AluOperation::Dot, "dot", "a b + c d + ... of 1 to 32 pairs, in the format of --accumulator"),
    (
        AluOperation::Quantize,
        "quantize",
        "from 1 to 32 numbers, a block in the format of --block: first its scale, then its elements",
    ),
    (
        AluOperation::Dequantize,
        "dequantize",
        "the numbers of a block in the format of --block (first its scale, then its elements)",
    ),
];

impl AluOperation {
    pub(super) fn parser() -> OneOf<Self> {
        one_of(NAMED.map(|(operation, name, help)| (name, help, operation)))
    }

    pub(super) fn name(self) -> &'static str {
        NAMED.iter().find(|(operation, ..)| *operation == self).map_or("", |&(_, name, _)| name)
    }

    /// For operations on blocks, sums and vectors: how many words a line may have, and how errors describe them; `None`
    /// for other operations.
    fn many(self) -> Option<(RangeInclusive<usize>, &'static str)> {
        Some(match self {
            Self::Quantize => (1..=BLOCK, "1 to 32 numbers"),
            Self::Dequantize => (2..=BLOCK + 1, "a scale and 1 to 32 elements"),
            Self::Dot => (2..=2 * BLOCK, "1 to 32 pairs of numbers"),
            Self::Dp3 => (6..=6, "6 numbers (a.x a.y a.z b.x b.y b.z)"),
            Self::Dph | Self::Dp4 | Self::Dst => (8..=8, "8 numbers (a.x to a.w, b.x to b.w)"),
            Self::Expp | Self::Logp => (1..=1, "1 number"),
            Self::Lit => (3..=3, "3 numbers (x, y, w)"),
            _ => return None,
        })
    }

    /// Returns `true` for blocks, sums and vectors, whose lines have many numbers.
    pub(super) fn takes_many(self) -> bool {
        self.many().is_some()
    }

    pub(super) fn words(self) -> (RangeInclusive<usize>, &'static str) {
        let operands = match self {
            Self::Table(operation) => operation.operands(),
            Self::Mad => 3,
            Self::Set(..) => 2,
            _ => 1,
        };
        self.many().unwrap_or((operands..=operands, ["1 operand", "2 operands", "3 operands"][operands - 1]))
    }

    /// Returns `true` if the result is 0 or 1 rather than a number of the format.
    pub(super) const fn is_comparison(self) -> bool {
        matches!(self, Self::Table(Op::Equal | Op::LessEqual | Op::Less))
    }
}

#[derive(Clone, Copy, Debug)]
pub(super) struct AluUnit {
    pub(super) op: AluOperation,
    /// The format of the operands; for blocks, the format of the plain numbers.
    pub(super) env: Env,
    /// The format of the result: the operands' format, except for `convert`.
    pub(super) to: Format,
    pub(super) seed: u64,
    pub(super) sums: Option<SumRules>,
    pub(super) block: Option<BlockFormat>,
    /// The order of `dot`, and its accumulator.
    pub(super) dot: (DotOrder, Format),
}

impl AluUnit {
    /// Format of the scale or the elements of a block; `None` for numbers of plain format.
    fn block_format(&self, op: AluOperation, at: usize) -> Option<Format> {
        self.block.filter(|_| self.op == op).map(|block| if at == 0 { Format::E8M0 } else { block.element() })
    }

    pub(super) fn operand_width(&self, at: usize) -> u32 {
        self.block_format(AluOperation::Dequantize, at).unwrap_or(self.env.format).width()
    }

    pub(super) fn result_width(&self, at: usize) -> u32 {
        let format = self.block_format(AluOperation::Quantize, at).unwrap_or(self.to);
        if self.op.is_comparison() { 1 } else { format.width() }
    }

    pub(super) const fn is_nan(&self, result: u32) -> bool {
        !self.op.is_comparison() && self.to.is_nan(result)
    }

    /// Returns the results of a line, a block's scale first; stochastic rounding uses random word `index`.
    pub(super) fn evaluate(&self, words: &[u32], index: u64) -> Vec<Outcome> {
        use AluOperation as Alu;
        let (mut env, mut to) = (self.env, self.to);
        for format in [&mut env.format, &mut to] {
            if let Rounding::Stochastic(word) = &mut format.rounding {
                *word = random_word(self.seed, index);
            }
        }
        let sums = self.sums.unwrap_or(SumRules::plain(env.format));
        let [a, b, c] = [0, 1, 2].map(|at| words.get(at).copied().unwrap_or_default());
        let one = Outcome::exact(env.format.one());
        let table = |operation: Op| operation.evaluate(env, [a, b, c]).expect("the command refuses what a unit lacks");
        vec![match self.op {
            Alu::Table(Op::Add) => sums.add(env, a, b),
            Alu::Table(Op::Mul) => sums.mul(env, a, b),
            Alu::Mad => sums.mad(env, a, b, c),
            Alu::Mov => ops::convert(&env.format, env, a),
            Alu::Rcc => Outcome::exact(nv_functions::rcc(a)),
            Alu::Set(operation, swapped) => set(env, operation, if swapped { [b, a] } else { [a, b] }),
            Alu::Table(operation) => table(operation),
            Alu::RoundToInt => ops::round_to_int(env, a),
            Alu::Convert => ops::convert(&env.format, to.tininess(env.tininess), a),
            Alu::Dot => {
                let terms: Vec<(u32, u32)> = words.chunks_exact(2).map(|pair| (pair[0], pair[1])).collect();
                let (order, accumulator) = self.dot;
                ops::dot_accumulated(env, accumulator.tininess(env.tininess), order, &terms)
            }
            Alu::Dp3 | Alu::Dp4 => dot(env, sums, words),
            Alu::Dph => homogeneous(env, sums, words),
            Alu::Dst => return vec![one, sums.mul(env, b, words[5]), Outcome::exact(c), Outcome::exact(words[7])],
            Alu::Lit => return vec![one, table(Op::LitDiffuse), table(Op::LitSpecular), one],
            Alu::Expp => return vec![table(Op::ExpFloor), table(Op::ExpFraction), table(Op::ExpPower), one],
            Alu::Logp => return vec![table(Op::LogExponent), table(Op::LogMantissa), table(Op::LogPower), one],
            Alu::Quantize => {
                let Some(made) = self.block.map(|block| block.quantize(&env.format, words)) else { return Vec::new() };
                let elements = made.elements.into_iter().map(Outcome::exact);
                return std::iter::once(Outcome::new(made.scale, made.flags)).chain(elements).collect();
            }
            Alu::Dequantize => {
                return self.block.map(|block| block.dequantize(env, a, &words[1..])).unwrap_or_default();
            }
        }]
    }
}

fn dot(env: Env, sums: SumRules, words: &[u32]) -> Outcome {
    let (a, b) = words.split_at(words.len() / 2);
    let terms: Vec<(u32, u32)> = a.iter().copied().zip(b.iter().copied()).collect();
    sums.dot(env, env.format, &terms)
}

/// DPH: in a card's unit a dot product with 1 as the fourth component of `a`, otherwise one of three, and a sum.
fn homogeneous(env: Env, sums: SumRules, words: &[u32]) -> Outcome {
    let mut words = words.to_vec();
    if env.format.unit.is_card() {
        words[3] = env.format.one();
        return dot(env, sums, &words);
    }
    let last = words.remove(7);
    words.remove(3);
    let three = dot(env, sums, &words);
    sums.add(env, three.bits, last).also(three.flags)
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
