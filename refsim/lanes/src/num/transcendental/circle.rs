//! Enclosures of sine and cosine, to any number of places.

use num_bigint::BigInt;
use num_traits::One;

use super::enclose::Enclosure;

/// Guard bits beyond the places requested.
const GUARD: u32 = 32;

/// `cos x` or `sin x` for `x = (-1)^sign * sig * 2^exp / den`, in units of `2^-places`.
///
/// The angle is reduced modulo `2 pi` into +-pi, with one extra bit of pi per integer bit of the angle; then the power
/// series is summed. Truncation error in units of `2^-(places + 32)`: one from `x`, below `2^9` from the multiple of
/// `2 pi`, and four per term of the series. With fewer than `2^13` terms the total is below `2^20`, a small part of one
/// unit of `2^-places`.
pub(super) fn circular(sine: bool, sign: bool, sig: u64, exp: i32, den: u32, places: u32) -> Enclosure<BigInt> {
    let whole = u32::try_from(exp + 64).unwrap_or(0);
    let bits = places + GUARD + whole;
    let signed = if sign { -BigInt::from(sig) } else { BigInt::from(sig) };
    let shift = i64::from(bits) + i64::from(exp);
    let shifted = if shift >= 0 { signed << shift } else { signed >> -shift };
    let x = shifted / den;
    let half_turn = pi(bits);
    let turn: BigInt = &half_turn << 1;
    // The nearest multiple: a shift rounds toward minus infinity, a division toward zero.
    let moved = &x + &half_turn;
    let mut turns = &moved / &turn;
    if moved < BigInt::ZERO {
        turns -= 1;
    }
    let angle: BigInt = (x - turns * turn) >> whole;
    let bits = bits - whole;
    let square: BigInt = (&angle * &angle) >> bits;
    let mut term = if sine { angle } else { BigInt::one() << bits };
    let (mut sum, mut k) = (term.clone(), if sine { 2u32 } else { 1 });
    loop {
        term = -((term * &square) >> bits) / (k * (k + 1));
        if term == BigInt::ZERO {
            break;
        }
        sum += &term;
        k += 2;
    }
    let low: BigInt = (sum >> GUARD) - 1;
    Enclosure { high: &low + 3, low, exp: -places.cast_signed() }
}

/// pi in units of `2^-bits`, with an error of a few units: `16 atan(1/5) - 4 atan(1/239)` (Machin).
pub(super) fn pi(bits: u32) -> BigInt {
    const SPARE: u32 = 16;
    let value: BigInt = 16 * arc_tangent(5, bits + SPARE) - 4 * arc_tangent(239, bits + SPARE);
    value >> SPARE
}

/// `atan(1 / n)` in units of `2^-bits`, with an error of one unit per term.
fn arc_tangent(n: u32, bits: u32) -> BigInt {
    let mut power = (BigInt::one() << bits) / n;
    let (mut sum, mut k) = (power.clone(), 1u32);
    while power != BigInt::ZERO {
        power = -power / (n * n);
        k += 2;
        sum += &power / k;
    }
    sum
}
