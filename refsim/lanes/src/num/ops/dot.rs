//! Dot products with a given order of summation.

use num_bigint::BigInt;
use num_traits::ToPrimitive;

use super::mul::product;
use super::{MAX_ALIGNED_BITS, add, convert, sum_aligned};
use crate::num::Format;
use crate::num::env::Env;
use crate::num::flags::{Flags, Outcome};
use crate::num::round::{from_parts, from_ratio, infinite, zero};
use crate::num::sum::{Term, cancelled};
use crate::num::unit;
use crate::num::unpack::{Unpacked, invalid, nan_result, unpack};

/// Order in which the terms of a dot product are summed. The cards' documents leave the order open, so it is a switch
/// of the device profile.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DotOrder {
    /// Each product is rounded, then `((x + y) + z) + w`, each sum rounded.
    Sequential,
    /// Each product is rounded, then neighbours are added in pairs: `(x + y) + (z + w)`, `(x + y) + z`.
    Tree,
    /// The exact sum of the exact products, rounded once.
    Exact,
    /// Each product is rounded, then one adder sums all products, keeping this many bits (at most [`MAX_ALIGNED_BITS`])
    /// below the largest exponent ([`sum_aligned`]). In fixed point this acts as [`Self::Sequential`].
    Aligned(u8),
}

impl DotOrder {
    /// The order with this name in profiles and options: `sequential`, `tree`, `exact`, or `aligned:F` with `F` kept
    /// bits.
    pub fn named(text: &str) -> Option<Self> {
        match text {
            "sequential" => Some(Self::Sequential),
            "tree" => Some(Self::Tree),
            "exact" => Some(Self::Exact),
            _ => aligned_bits(text).map(Self::Aligned),
        }
    }
}

/// Parses the number of kept bits in `aligned:F`, 0 to [`MAX_ALIGNED_BITS`].
pub fn aligned_bits(text: &str) -> Option<u8> {
    text.strip_prefix("aligned:")?.parse().ok().filter(|bits| *bits <= MAX_ALIGNED_BITS)
}

/// Sums the products of `terms` (dp2, dp3, dp4; any number of terms works, an empty sum is +0). Units of cards have a
/// fixed order and ignore the order given.
pub fn dot(env: impl Into<Env>, order: DotOrder, terms: &[(u32, u32)]) -> Outcome {
    let env = env.into();
    accumulated(env, env, &env.format, order, terms)
}

/// [`dot`] with an accumulator in another format: operands and result are in `env`'s format. The exact products, and
/// the sums in the given order, are rounded into the accumulator's format; the last sum is then rounded into the
/// result's format. With [`DotOrder::Exact`] the exact sum is rounded into the accumulator.
///
/// If the accumulator represents every operand, this equals an instruction that computes in the accumulator's format.
pub fn dot_accumulated(
    env: impl Into<Env>,
    accumulator: impl Into<Env>,
    order: DotOrder,
    terms: &[(u32, u32)],
) -> Outcome {
    let accumulator = accumulator.into();
    dot_of_products(env, accumulator, accumulator, order, terms)
}

/// [`dot_accumulated`] with products rounded by the rules of another format with the accumulator's layout.
/// [`DotOrder::Exact`] has no rounded products.
pub fn dot_of_products(
    env: impl Into<Env>,
    products: impl Into<Env>,
    accumulator: impl Into<Env>,
    order: DotOrder,
    terms: &[(u32, u32)],
) -> Outcome {
    let (env, accumulator) = (env.into(), accumulator.into());
    let sum = accumulated(products.into(), accumulator, &env.format, order, terms);
    convert(&accumulator.format, env, sum.bits).also(sum.flags)
}

/// Sums the products of numbers of a format, rounded into the accumulator.
fn accumulated(rounded: Env, env: Env, operands: &Format, order: DotOrder, terms: &[(u32, u32)]) -> Outcome {
    if env.format.unit.is_card() {
        // Units of cards only compute in their own format.
        let word = |bits| convert(operands, env, bits).bits;
        let terms: Vec<(u32, u32)> = terms.iter().map(|&(a, b)| (word(a), word(b))).collect();
        return unit::dot(&env.format, &terms).unwrap_or(Outcome::exact(0));
    }
    let products = || terms.iter().map(|&(a, b)| product(&rounded, unpack(operands, a), unpack(operands, b)));
    match order {
        DotOrder::Aligned(bits) if !env.format.is_fixed() => {
            let products: Vec<Outcome> = products().collect();
            let addends: Vec<u32> = products.iter().map(|product| product.bits).collect();
            let raised = products.iter().fold(Flags::empty(), |flags, product| flags | product.flags);
            sum_aligned(env, bits, &addends).also(raised)
        }
        DotOrder::Exact => exact(&env, operands, terms),
        DotOrder::Sequential | DotOrder::Aligned(_) => products()
            .reduce(|sum, term| add(env, sum.bits, term.bits).also(sum.flags | term.flags))
            .unwrap_or(Outcome::exact(0)),
        DotOrder::Tree => {
            let mut level: Vec<Outcome> = products().collect();
            while level.len() > 1 {
                level = level
                    .chunks(2)
                    .map(|pair| match pair {
                        [a, b] => add(env, a.bits, b.bits).also(a.flags | b.flags),
                        _ => pair[0],
                    })
                    .collect();
            }
            level.first().copied().unwrap_or(Outcome::exact(0))
        }
    }
}

/// Computes a dot product with one rounding: special values first, then the finite terms.
fn exact(env: &Env, from: &Format, terms: &[(u32, u32)]) -> Outcome {
    use Unpacked::{Finite, Inf, Nan};
    let format = &env.format;
    let mut finite = Vec::with_capacity(terms.len());
    let mut operands = Vec::with_capacity(2 * terms.len());
    let (mut nan, mut bad) = (false, false);
    let mut infinity: Option<bool> = None;
    for &(a, b) in terms {
        let (a, b) = (unpack(from, a), unpack(from, b));
        operands.extend([a, b]);
        match (a, b) {
            (Nan { .. }, _) | (_, Nan { .. }) => nan = true,
            (Inf { .. }, Finite { sig: 0, .. }) | (Finite { sig: 0, .. }, Inf { .. }) => bad = true,
            (Finite { sign: sa, sig: ma, exp: ea, .. }, Finite { sign: sb, sig: mb, exp: eb, .. }) => {
                finite.push(Term { sign: sa != sb, sig: ma * mb, exp: ea + eb });
            }
            (Inf { sign: sa }, Inf { sign: sb } | Finite { sign: sb, .. })
            | (Finite { sign: sa, .. }, Inf { sign: sb }) => {
                bad |= infinity.is_some_and(|sign| sign != (sa != sb));
                infinity = Some(sa != sb);
            }
        }
    }
    // As in `fused_mad`, an invalid product or sum takes precedence over a NaN operand.
    if bad {
        return invalid(format);
    }
    if nan {
        return nan_result(format, &operands);
    }
    infinity.map_or_else(|| exact_finite(env, from, &finite), |sign| infinite(format, sign))
}

fn exact_finite(env: &Env, from: &Format, terms: &[Term]) -> Outcome {
    let nonzero = || terms.iter().filter(|t| t.sig != 0);
    let Some(unit) = nonzero().map(|t| t.exp).min() else {
        // All products are zeros: the result has their common sign, if they have one.
        let sign = match terms.iter().map(|t| t.sign).collect::<Vec<_>>().as_slice() {
            [] => false,
            [first, rest @ ..] if rest.iter().all(|s| s == first) => *first,
            _ => cancelled(env),
        };
        return zero(&env.format, sign);
    };
    let reach = nonzero().map(|t| t.exp + 64 - t.sig.leading_zeros().cast_signed()).max().unwrap_or(unit);
    let den = u128::from(from.denominator());
    if den > 1 || (reach - unit < 120 && terms.len() <= 64) {
        let total: i128 = nonzero()
            .map(|t| {
                let value = i128::from(t.sig) << (t.exp - unit);
                if t.sign { -value } else { value }
            })
            .sum();
        if total == 0 {
            return zero(&env.format, cancelled(env));
        }
        return match den {
            1 => from_parts(*env, total < 0, total.unsigned_abs(), unit, false),
            // Normalized numbers have no exponents.
            _ => from_ratio(*env, total < 0, total.unsigned_abs(), den * den),
        };
    }
    let total: BigInt = nonzero()
        .map(|t| {
            let value = BigInt::from(t.sig) << (t.exp - unit).unsigned_abs();
            if t.sign { -value } else { value }
        })
        .sum();
    let magnitude = total.magnitude();
    if magnitude.bits() == 0 {
        return zero(&env.format, cancelled(env));
    }
    let drop = magnitude.bits().saturating_sub(120);
    let lost = magnitude.trailing_zeros().unwrap_or(0) < drop;
    let kept = (magnitude >> drop).to_u128().unwrap_or(0);
    from_parts(*env, total.sign() == num_bigint::Sign::Minus, kept, unit + i32::try_from(drop).unwrap_or(0), lost)
}
