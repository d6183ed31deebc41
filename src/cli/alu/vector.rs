//! Instructions on vectors: a line of words, components first to last, first all of `a`, then all of `b`.

use refsim::device::SumRules;
use refsim::num::{Env, NumberOperation as Op, Outcome};

use super::operation::VectorOperation;

impl VectorOperation {
    /// The number of words per line, and the message for a line with a different number.
    pub(super) const fn words(self) -> (usize, &'static str) {
        match self {
            Self::Dp3 => (6, "6 numbers (a.x a.y a.z b.x b.y b.z)"),
            Self::Dph | Self::Dp4 | Self::Dst => (8, "8 numbers (a.x to a.w, b.x to b.w)"),
            Self::Expp | Self::Logp => (1, "1 number"),
            Self::Lit => (3, "3 numbers (x, y, w)"),
        }
    }

    /// The result: one number, or four components. `words` has [`Self::words`] words.
    pub(super) fn evaluate(self, env: Env, sums: SumRules, words: &[u32]) -> Vec<Outcome> {
        let one = Outcome::exact(env.format.one());
        // The caller rejects formats whose unit lacks the instruction.
        let unit = |operation: Op, operands| operation.evaluate(env, operands).unwrap_or(Outcome::exact(0));
        match self {
            Self::Dp3 | Self::Dp4 => vec![dot(env, sums, words)],
            Self::Dph => vec![homogeneous(env, sums, words)],
            Self::Dst => {
                vec![one, sums.mul(env, words[1], words[5]), Outcome::exact(words[2]), Outcome::exact(words[7])]
            }
            Self::Expp => {
                let [x, y, z] = [Op::ExpFloor, Op::ExpFraction, Op::ExpPower].map(|op| unit(op, [words[0], 0, 0]));
                vec![x, y, z, one]
            }
            Self::Logp => {
                let [x, y, z] = [Op::LogExponent, Op::LogMantissa, Op::LogPower].map(|op| unit(op, [words[0], 0, 0]));
                vec![x, y, z, one]
            }
            Self::Lit => {
                let operands = [words[0], words[1], words[2]];
                vec![one, unit(Op::LitDiffuse, operands), unit(Op::LitSpecular, operands), one]
            }
        }
    }
}

/// The dot product of the two halves of the words.
fn dot(env: Env, sums: SumRules, words: &[u32]) -> Outcome {
    let (a, b) = words.split_at(words.len() / 2);
    let terms: Vec<(u32, u32)> = a.iter().copied().zip(b.iter().copied()).collect();
    sums.dot(env, env.format, &terms)
}

/// DPH: in a card's unit, with 1 as the fourth component of `a`; otherwise the dot product of three components, and a
/// sum.
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
