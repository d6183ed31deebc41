//! AMD's CDNA1 to CDNA3, and fused multiply-adds.

use super::element::{Element, Value, special};
use super::result::{ResultFormat, exact_sum, term};
use crate::num::aligned::{Addend, Alignment, aligned};
use crate::num::{Denormals, Format, ops};

/// CDNA1: the exact sum of a block, rounded once.
pub(super) fn exact(products: &[Value], c: Value, result: ResultFormat) -> u64 {
    let addends = || products.iter().copied().chain([c]);
    if let Some(value) = special(addends()) {
        return result.special(value);
    }
    let (negative, magnitude, exponent) = exact_sum(&addends().filter_map(Value::addend).map(term).collect::<Vec<_>>());
    result.round(negative, magnitude, exponent)
}

/// `fma(a, b, c)`: the exact value, rounded once; the signs of zeros as IEEE has them.
pub(super) fn fused(a: Value, b: Value, c: Value, result: ResultFormat) -> u64 {
    let (Value::Finite(x), Value::Finite(y), Value::Finite(z)) = (a, b, c) else {
        // Products of double precision do not fit; that of no number needs no digits.
        let one = |v: Value| v.addend().map_or(v, |x| Value::Finite(Addend { magnitude: 1, ..x }));
        return result.special(special([one(a).times(one(b)), c]).unwrap_or(Value::Nan));
    };
    let negative = x.negative != y.negative;
    let exponent = x.exponent + y.exponent - (x.fraction + y.fraction).cast_signed();
    let product = (negative, u128::from(x.magnitude) * u128::from(y.magnitude), exponent);
    let (sign, magnitude, exponent) = exact_sum(&[product, term(z)]);
    let both_negative_zero = product.1 == 0 && z.magnitude == 0 && negative && z.negative;
    let zero = u64::from(both_negative_zero) << (result.element().width() - 1);
    if magnitude == 0 { zero } else { result.round(sign, magnitude, exponent) }
}

/// CDNA2: operations of single precision that flush subnormal results, in pairs.
pub(super) fn pairs(a: &[Value], b: &[Value], block: usize, c: Value) -> u64 {
    let format = Format::FP32.with_denormals(Denormals::Flush);
    // Operands that are subnormal in their own type become +0, as zeros do.
    let word = |value: Value| match value {
        Value::Finite(x) if x.magnitude >> x.fraction == 0 => 0,
        Value::Finite(x) => {
            let (negative, magnitude, exponent) = term(x);
            ResultFormat::Nearest32.round(negative, magnitude, exponent) as u32
        }
        other => ResultFormat::Nearest32.special(other) as u32,
    };
    let product = |k: usize| match (a.get(k), b.get(k)) {
        (Some(&x), Some(&y)) => ops::mul(format, word(x), word(y)).bits,
        _ => 0,
    };
    let add = |x: u32, y: u32| ops::add(format, x, y).bits;
    let mut sum = add(product(0), product(1));
    if block == 4 {
        sum = add(sum, add(product(2), product(3)));
    }
    add(word(c), sum).into()
}

/// Bits below the largest exponent that CDNA3 keeps of products, and of `c` beside them.
const KEPT: u32 = 24;
/// Bits below the larger of both that it keeps of the sum of products.
const SUM_KEPT: i32 = 32;

/// CDNA3: products are aligned and cut, their sum and `c` are brought together by floors. `halves` has those of even
/// and of odd index apart (FP8).
pub(super) fn floored(products: &[Value], c: Value, halves: bool) -> u64 {
    let result = ResultFormat::Nearest32;
    let limited = products.iter().map(|&product| if halves { product } else { overflowing(product) });
    if let Some(value) = special(limited.chain([c])) {
        return result.special(value);
    }
    let of = |parity: usize| -> Vec<Addend> {
        let mine = products.iter().enumerate().filter(|(k, _)| !halves || k % 2 == parity);
        mine.filter_map(|(_, product)| product.addend()).collect()
    };
    let sides: Vec<_> = (0..1 + usize::from(halves)).map(of).filter(|side| !side.is_empty()).collect();
    let sums: Vec<_> = sides.iter().map(|side| aligned(side.iter().copied(), KEPT, None, Alignment::Cut)).collect();
    let Value::Finite(c) = c else { return result.special(c) };
    let c_exponent = if c.magnitude == 0 { Element::FP32.least_exponent() } else { c.exponent };
    let products_top = sums.iter().map(|sum| sum.top).max();
    let top = products_top.map_or(c_exponent, |t| t.max(c_exponent));
    let floor = |value: i128, by: i32| value >> by.clamp(0, 127);
    let together: i128 = sums.iter().map(|sum| floor(sum.sum, products_top.unwrap_or(0) - sum.top)).sum();
    // Units of 2^(top - 32) from here.
    let finer = SUM_KEPT - KEPT.cast_signed();
    let u = floor(together << finer, top - products_top.unwrap_or(top));
    let c_floor = aligned([c], KEPT, Some(top), Alignment::Floor).sum;
    let v = if halves && c_exponent < top - 25 || c.magnitude == 0 { 0 } else { c_floor << finer };
    let y = u + v;
    let exponent = top - SUM_KEPT;
    if y == 0 {
        return 0;
    }
    let n = (y.unsigned_abs().ilog2().cast_signed() + exponent).max(Element::FP32.least_exponent());
    let dropped = (n - 31 - exponent).max(0);
    let kept = floor(y, dropped);
    result.round(kept < 0, kept.unsigned_abs(), exponent + dropped)
}

/// A product of `2^128` and more is an infinity.
fn overflowing(product: Value) -> Value {
    match product.addend() {
        Some(x) if x.magnitude.ilog2().cast_signed() + x.exponent - x.fraction.cast_signed() >= 128 => {
            Value::Infinite { negative: x.negative }
        }
        _ => product,
    }
}
