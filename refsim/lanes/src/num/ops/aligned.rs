//! Sums of an adder that aligns its addends, and the multiply-add that truncates its product.

use super::mad;
use crate::num::aligned::{Addend, Alignment, aligned};
use crate::num::env::Env;
use crate::num::flags::{Flags, Outcome};
use crate::num::format::FormatKind;
use crate::num::round::{from_parts, infinite, zero};
use crate::num::sum::{Term, cancelled, sum};
use crate::num::unpack::{Unpacked, invalid, nan_result, unpack};

/// The most bits below the largest exponent that a four-addend adder keeps: their sum has 31 bits and a sign.
pub const MAX_ALIGNED_BITS: u8 = 28;

/// Sums numbers of a float format in one adder: addends are truncated to `bits` bits below the largest exponent of any
/// leading bit and added exactly; the sum is rounded once. `bits` is at most [`MAX_ALIGNED_BITS`]; more count as that
/// many. Dropped bits raise `INEXACT`.
///
/// Infinities of both signs are `INVALID`. Zeros don't count as addends. A sum of zeros that all have the same sign has
/// that sign; other zero sums are +0, or -0 when rounding down.
pub fn sum_aligned(env: impl Into<Env>, bits: u8, addends: &[u32]) -> Outcome {
    let env = env.into();
    let format = &env.format;
    let numbers: Vec<Unpacked> = addends.iter().map(|&addend| unpack(format, addend)).collect();
    let has_infinity = |negative| numbers.contains(&Unpacked::Inf { sign: negative });
    if has_infinity(false) && has_infinity(true) {
        return invalid(format);
    }
    if numbers.iter().any(|number| matches!(number, Unpacked::Nan { .. })) {
        return nan_result(format, &numbers);
    }
    if let Some(negative) = [false, true].into_iter().find(|&negative| has_infinity(negative)) {
        return infinite(format, negative);
    }
    let (mut terms, mut signs) = (Vec::with_capacity(numbers.len()), Vec::with_capacity(numbers.len()));
    for number in numbers {
        let Unpacked::Finite { sign, sig, exp, .. } = number else { continue };
        signs.push(sign);
        if sig != 0 {
            let fraction = sig.ilog2();
            terms.push(Addend { negative: sign, magnitude: sig, exponent: exp + fraction.cast_signed(), fraction });
        }
    }
    if terms.is_empty() {
        let one_sign = signs.windows(2).all(|pair| pair[0] == pair[1]);
        let sign = if one_sign { signs.first().copied().unwrap_or(false) } else { cancelled(&env) };
        return zero(format, sign);
    }
    let bits = u32::from(bits.min(MAX_ALIGNED_BITS));
    let total = aligned(terms.iter().copied(), bits, None, Alignment::Cut);
    let unit = total.top - bits.cast_signed();
    let last_bit =
        |term: &Addend| term.exponent - term.fraction.cast_signed() + term.magnitude.trailing_zeros().cast_signed();
    let dropped = if terms.iter().any(|term| last_bit(term) < unit) { Flags::INEXACT } else { Flags::empty() };
    if total.sum == 0 {
        return zero(format, cancelled(&env)).also(dropped);
    }
    from_parts(env, total.sum < 0, total.sum.unsigned_abs(), unit, false).also(dropped)
}

/// `a * b + c`: the product is truncated to the format's significand, with an unlimited exponent, and the exact sum is
/// rounded once. Special values are as in [`super::fused_mad`]. In fixed point this is [`mad`].
pub fn product_cut_mad(env: impl Into<Env>, a: u32, b: u32, c: u32) -> Outcome {
    use Unpacked::Finite;
    let env = env.into();
    let format = &env.format;
    let FormatKind::Float { man_bits, .. } = format.kind else { return mad(env, a, b, c) };
    match [a, b, c].map(|number| unpack(format, number)) {
        [
            Finite { sign: sa, sig: ma, exp: ea, .. },
            Finite { sign: sb, sig: mb, exp: eb, .. },
            Finite { sign: sc, sig: mc, exp: ec, .. },
        ] => {
            let product = ma * mb;
            let below = (64 - product.leading_zeros()).saturating_sub(u32::from(man_bits) + 1);
            let cut = product >> below << below;
            let lost = if cut == product { Flags::empty() } else { Flags::INEXACT };
            let product = Term { sign: sa != sb, sig: cut, exp: ea + eb };
            sum(&env, product, Term { sign: sc, sig: mc, exp: ec }).also(lost)
        }
        _ => super::fused_mad(env, a, b, c),
    }
}
