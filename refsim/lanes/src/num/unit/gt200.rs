//! Sums, products and comparisons of GT200. Subnormal operands always count as zeros of their sign.

use std::cmp::Ordering;

use super::word::{INFINITY, LARGEST, NAN, ONE, SIGN, Word, assemble, signed, top24};
use crate::num::rules::{Rounding, Unit};

/// A nonzero number `(-1)^negative * magnitude * 2^exponent`.
#[derive(Clone, Copy, Debug)]
struct Exact {
    negative: bool,
    magnitude: u128,
    exponent: i32,
}

impl Exact {
    /// A finite nonzero word.
    fn of(word: Word) -> Self {
        Self { negative: word.negative, magnitude: word.significand().into(), exponent: word.field - 150 }
    }

    /// The exact product, at most 48 bits.
    fn times(self, other: Self) -> Self {
        Self {
            negative: self.negative != other.negative,
            magnitude: self.magnitude * other.magnitude,
            exponent: self.exponent + other.exponent,
        }
    }

    /// The sum of numbers of at most 24 bits, `None` if it is zero. Bits more than 80 positions below the larger number
    /// are merged into one bit, which does not change any rounding to 24 bits.
    fn plus(self, other: Self) -> Option<Self> {
        const FAR: i32 = 80;
        let (high, low) = if self.exponent >= other.exponent { (self, other) } else { (other, self) };
        let exponent = low.exponent.max(high.exponent - FAR);
        let shifted = |number: Self| {
            let distance = number.exponent - exponent;
            let magnitude = if distance >= 0 { number.magnitude << distance } else { 1 };
            if number.negative { -magnitude.cast_signed() } else { magnitude.cast_signed() }
        };
        let sum = shifted(high) + shifted(low);
        (sum != 0).then_some(Self { negative: sum < 0, magnitude: sum.unsigned_abs(), exponent })
    }

    fn cut24(self) -> Self {
        let drop = self.magnitude.ilog2().saturating_sub(23);
        Self { magnitude: self.magnitude >> drop, exponent: self.exponent + drop.cast_signed(), ..self }
    }

    /// Rounds to 24 bits with an unlimited exponent; a result below `2^-126` is a zero of its sign.
    fn round(self, rounding: Rounding) -> u32 {
        let drop = self.magnitude.ilog2().saturating_sub(23);
        let rounded = nearest_even(self.magnitude, drop);
        let kept = if rounding == Rounding::TowardZero { self.magnitude >> drop } else { rounded };
        // At most 2^24.
        let (place, mantissa) = top24(kept as u64);
        match 127 + self.exponent + drop.cast_signed() + place {
            ..=0 => signed(self.negative, 0),
            255.. if rounding == Rounding::TowardZero => signed(self.negative, LARGEST),
            255.. => signed(self.negative, INFINITY),
            field => assemble(self.negative, field, mantissa),
        }
    }

    /// Rounds a sum of MAD to nearest. A sum below `2^-126` is first truncated to a multiple of `2^-153`, then rounded
    /// to a multiple of `2^-149`; the result is `2^-126` or a zero of its sign.
    fn round_mad(self) -> u32 {
        if self.magnitude.ilog2().cast_signed() + self.exponent >= -126 {
            return self.round(Rounding::NearestEven);
        }
        let left = self.exponent + 153;
        // Below 2^27.
        let cut = if left >= 0 { self.magnitude << left } else { self.magnitude >> left.unsigned_abs().min(127) };
        if nearest_even(cut, 4) < 1 << 23 { signed(self.negative, 0) } else { signed(self.negative, 1 << 23) }
    }
}

/// `magnitude / 2^drop`, to nearest, ties to even.
pub(super) const fn nearest_even(magnitude: u128, drop: u32) -> u128 {
    if drop == 0 {
        return magnitude;
    }
    let kept = magnitude >> drop;
    let rest = magnitude & ((1 << drop) - 1);
    let half = 1 << (drop - 1);
    if rest > half || rest == half && kept % 2 == 1 { kept + 1 } else { kept }
}

/// Flushes a subnormal number to zero; the sign stays.
pub(super) const fn flushed(x: u32) -> u32 {
    if Word::of(x).is_zero() { x & SIGN } else { x }
}

/// The result of a sum with a NaN or infinite addend; `None` for other sums.
fn special_sum(x: Word, y: Word) -> Option<u32> {
    match (x.is_infinite(), y.is_infinite()) {
        _ if x.is_nan() || y.is_nan() => Some(NAN),
        (true, true) if x.negative != y.negative => Some(NAN),
        (true, _) => Some(signed(x.negative, INFINITY)),
        (_, true) => Some(signed(y.negative, INFINITY)),
        (false, false) => None,
    }
}

/// `a + b`, rounded once: to the nearest, or toward zero.
pub fn add(rounding: Rounding, a: u32, b: u32) -> u32 {
    let (x, y) = (Word::of(a), Word::of(b));
    if let Some(special) = special_sum(x, y) {
        return special;
    }
    match (x.is_zero(), y.is_zero()) {
        (true, true) => a & b & SIGN,
        (true, false) => b,
        (false, true) => a,
        (false, false) => Exact::of(x).plus(Exact::of(y)).map_or(0, |sum| sum.round(rounding)),
    }
}

/// The result of a product with a zero, NaN or infinite factor; `None` for other products.
fn special_product(unit: Unit, x: Word, y: Word) -> Option<u32> {
    let negative = x.negative != y.negative;
    let zero = x.is_zero() || y.is_zero();
    match x.is_infinite() || y.is_infinite() {
        _ if zero && unit == Unit::Gt200ZeroWins => Some(0),
        _ if x.is_nan() || y.is_nan() => Some(NAN),
        true if zero => Some(NAN),
        true => Some(signed(negative, INFINITY)),
        false if zero => Some(signed(negative, 0)),
        false => None,
    }
}

/// `a b`, rounded once: to the nearest, or toward zero.
pub fn mul(unit: Unit, rounding: Rounding, a: u32, b: u32) -> u32 {
    let (x, y) = (Word::of(a), Word::of(b));
    special_product(unit, x, y).unwrap_or_else(|| Exact::of(x).times(Exact::of(y)).round(rounding))
}

/// `a b + c`: the product truncated to 24 bits with an unlimited exponent, and the sum rounded to nearest. Only if an
/// operand is zero are product and sum both rounded to nearest. MAD has no rounding mode: the two roundings above are
/// fixed.
pub fn mad(unit: Unit, a: u32, b: u32, c: u32) -> u32 {
    let (x, y, z) = (Word::of(a), Word::of(b), Word::of(c));
    let zero = x.is_zero() || y.is_zero();
    let finite = x.field < 255 && y.field < 255 && z.field < 255;
    if z.field == 255 && special_product(unit, x, y).is_none() {
        // With an infinite or NaN addend the product does not matter, even if it would overflow.
        return add(Rounding::NearestEven, 0, c);
    }
    if zero || z.is_zero() || !finite {
        return add(Rounding::NearestEven, mul(unit, Rounding::NearestEven, a, b), c);
    }
    let product = Exact::of(x).times(Exact::of(y)).cut24();
    product.plus(Exact::of(z)).map_or(0, Exact::round_mad)
}

/// A dot product as drivers compile it: MUL, then MAD for every further term. Without terms it is +0.
pub fn dot(unit: Unit, rounding: Rounding, terms: &[(u32, u32)]) -> u32 {
    let Some((&(a, b), rest)) = terms.split_first() else { return 0 };
    rest.iter().fold(mul(unit, rounding, a, b), |sum, &(a, b)| mad(unit, a, b, sum))
}

/// `x 2^k`, exact, except that it overflows and underflows like a product.
pub fn scale(rounding: Rounding, x: u32, k: i32) -> u32 {
    let word = Word::of(x);
    match word.field {
        _ if word.is_nan() => NAN,
        0 => x & SIGN,
        255 => x,
        _ => {
            let number = Exact::of(word);
            Exact { exponent: number.exponent + k.clamp(-1000, 1000), ..number }.round(rounding)
        }
    }
}

/// The order of two numbers, `None` with a NaN; zeros are equal.
pub fn compare(a: u32, b: u32) -> Option<Ordering> {
    let key = |word: u32| {
        let magnitude = i64::from(flushed(word) & !SIGN);
        if word & SIGN != 0 { -magnitude } else { magnitude }
    };
    let ordered = !Word::of(a).is_nan() && !Word::of(b).is_nan();
    ordered.then(|| key(a).cmp(&key(b)))
}

/// MIN, or MAX if `greater`. If one operand is NaN, returns the other one; -0 is below +0.
fn choose(a: u32, b: u32, greater: bool) -> u32 {
    match (Word::of(a).is_nan(), Word::of(b).is_nan()) {
        (true, true) => return NAN,
        (true, false) => return flushed(b),
        (false, true) => return flushed(a),
        (false, false) => {}
    }
    let (a, b) = (flushed(a), flushed(b));
    let order = compare(a, b).unwrap_or(Ordering::Equal).then((b & SIGN).cmp(&(a & SIGN)));
    if order.is_gt() == greater { a } else { b }
}

/// The lesser of two numbers.
pub fn min(a: u32, b: u32) -> u32 {
    choose(a, b, false)
}

/// The greater of two numbers.
pub fn max(a: u32, b: u32) -> u32 {
    choose(a, b, true)
}

/// `x` clamped to [0, 1]; NaN stays, -0 gives +0.
pub fn saturate(x: u32) -> u32 {
    match Word::of(x) {
        word if word.is_nan() => NAN,
        Word { negative: true, .. } => 0,
        Word { field: 127.., .. } => ONE,
        _ => flushed(x),
    }
}

/// The largest integer not above `x`; zeros keep their sign.
pub fn floor(x: u32) -> u32 {
    let word = Word::of(x);
    match word.field {
        _ if word.is_nan() => NAN,
        0 => x & SIGN,
        150.. => x,
        field => {
            let drop = (150 - field).min(63);
            let whole = word.significand() >> drop;
            let rest = whole << drop != word.significand();
            match whole + u64::from(word.negative && rest) {
                0 => x & SIGN,
                magnitude => {
                    let (place, mantissa) = top24(magnitude);
                    assemble(word.negative, 127 + place, mantissa)
                }
            }
        }
    }
}
