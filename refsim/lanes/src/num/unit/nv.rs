//! Vertex units of NV20, NV25 ([`Unit::Nv2x`]) and NV30, NV35 ([`Unit::Nv3xLegacy`], [`Unit::Nv3x`], "modern").
//!
//! | | NV2x | NV3x legacy | NV3x modern |
//! |---|---|---|---|
//! | product | truncated to 24 bits | same | same |
//! | overflow | largest finite number | infinity | infinity |
//! | 0 (or subnormal) times anything | +0, NaN and infinity included | same | 0 times infinity or NaN is NaN, else +0 |
//! | subnormal addends | count half their IEEE value | skipped | skipped |
//! | -0 in comparisons | below +0 | same | equal |
//! | NaN in comparisons, min, max | ordered by its sign | same | result NaN |

use std::cmp::Ordering;

use super::word::{INFINITY, LARGEST, NAN, ONE, SIGN, Word, assemble, signed, top24};
use crate::num::aligned::{Addend, Alignment, aligned};
use crate::num::rules::Unit;

/// Bits of a sum below the leading bit of its largest addend: the 23 of a mantissa and 5 more.
const SUM_BITS: u32 = 28;

/// Assembles a result of any exponent: underflow gives a zero of its sign, overflow infinity or the largest number.
fn finish(unit: Unit, negative: bool, field: i32, mantissa: u32) -> u32 {
    match field {
        ..=0 => signed(negative, 0),
        255.. => signed(negative, if unit == Unit::Nv2x { LARGEST } else { INFINITY }),
        _ => assemble(negative, field, mantissa),
    }
}

/// `a b`, truncated to 24 bits.
pub fn mul(unit: Unit, a: u32, b: u32) -> u32 {
    let (x, y) = (Word::of(a), Word::of(b));
    if x.is_zero() || y.is_zero() {
        let finite = x.field < 255 && y.field < 255;
        return if finite || unit != Unit::Nv3x { 0 } else { NAN };
    }
    if x.is_nan() || y.is_nan() {
        return NAN;
    }
    let negative = x.negative != y.negative;
    if x.is_infinite() || y.is_infinite() {
        return signed(negative, INFINITY);
    }
    let (place, mantissa) = top24(x.significand() * y.significand());
    finish(unit, negative, x.field + y.field - 127 + place - 46, mantissa)
}

/// The sum of any number of addends in one adder: aligned to the largest and truncated; the sum is truncated to 24
/// bits.
pub fn sum(unit: Unit, addends: &[u32]) -> u32 {
    let words = || addends.iter().map(|&addend| Word::of(addend));
    let infinite = |negative| words().any(|word| word.is_infinite() && word.negative == negative);
    match (infinite(false), infinite(true)) {
        _ if words().any(Word::is_nan) => return NAN,
        (true, true) => return NAN,
        (true, false) => return INFINITY,
        (false, true) => return INFINITY | SIGN,
        (false, false) => {}
    }
    let aligned = aligned(words().filter_map(|word| addend(unit, word)), SUM_BITS, None, Alignment::Cut);
    if aligned.sum == 0 {
        return 0;
    }
    // An instruction has few addends, so the sum is below 2^64.
    let (place, mantissa) = top24(aligned.sum.unsigned_abs() as u64);
    finish(unit, aligned.sum < 0, aligned.top + place - SUM_BITS.cast_signed(), mantissa)
}

/// A finite word as an addend. NV3x ignores subnormals; NV2x adds them with half their value.
fn addend(unit: Unit, word: Word) -> Option<Addend> {
    let magnitude = match word.field {
        0 if unit == Unit::Nv2x => word.mantissa.into(),
        0 => return None,
        _ => word.significand(),
    };
    Some(Addend { negative: word.negative, magnitude, exponent: word.field, fraction: 23 })
}

/// `a + b`.
pub fn add(unit: Unit, a: u32, b: u32) -> u32 {
    sum(unit, &[a, b])
}

/// `a b + c`: the truncated product, then the adder.
pub fn mad(unit: Unit, a: u32, b: u32, c: u32) -> u32 {
    add(unit, mul(unit, a, b), c)
}

/// DP3 and DP4: products, then one sum. DPH is DP4 with 1.0 for the last component of `a`.
pub fn dot(unit: Unit, terms: &[(u32, u32)]) -> u32 {
    let products: Vec<u32> = terms.iter().map(|&(a, b)| mul(unit, a, b)).collect();
    sum(unit, &products)
}

/// DST: `(1, a.y b.y, a.z, b.w)`, the last two unchanged.
pub fn dst(unit: Unit, a: [u32; 4], b: [u32; 4]) -> [u32; 4] {
    [ONE, mul(unit, a[1], b[1]), a[2], b[3]]
}

/// The order of two words as sign and magnitude. In modern programs NaN is unordered (`None`) and the zeros are equal.
pub fn compare(unit: Unit, a: u32, b: u32) -> Option<Ordering> {
    let modern = unit == Unit::Nv3x;
    if modern && (Word::of(a).is_nan() || Word::of(b).is_nan()) {
        return None;
    }
    let key = |word: u32| match Word::of(word) {
        Word { field: 0, .. } if modern => 0,
        Word { negative: true, .. } => -i64::from(word & !SIGN) - 1,
        _ => i64::from(word),
    };
    Some(key(a).cmp(&key(b)))
}

/// `a < b ? a : b`
pub fn min(unit: Unit, a: u32, b: u32) -> u32 {
    compare(unit, a, b).map_or(NAN, |order| if order.is_lt() { a } else { b })
}

/// `a < b ? b : a`
pub fn max(unit: Unit, a: u32, b: u32) -> u32 {
    compare(unit, a, b).map_or(NAN, |order| if order.is_lt() { b } else { a })
}

/// SSG: -1, +0 or 1 as `x` compares with +0.
pub fn sign(unit: Unit, x: u32) -> u32 {
    match compare(unit, x, 0) {
        None => NAN,
        Some(Ordering::Less) => ONE | SIGN,
        Some(Ordering::Equal) => 0,
        Some(Ordering::Greater) => ONE,
    }
}

/// FLR: the largest integer not above `x`; zeros give +0.
pub fn floor(x: u32) -> u32 {
    let word = Word::of(x);
    match word.field {
        _ if word.is_nan() => NAN,
        0 => 0,
        150.. => x,
        ..127 if word.negative => ONE | SIGN,
        ..127 => 0,
        field => {
            // Mantissa units per 1: at least 2.
            let units = 1u32 << (150 - field);
            // Below zero, rounds to the next larger magnitude; a carry out of the mantissa increments the field.
            let up = if word.negative { x + (units - 1) } else { x };
            up & !(units - 1)
        }
    }
}

/// FRC: `x - floor(x)`, rounded by the adder: the result can be 1.0, and is NaN for infinities.
pub fn frc(unit: Unit, x: u32) -> u32 {
    add(unit, x, floor(x) ^ SIGN)
}
