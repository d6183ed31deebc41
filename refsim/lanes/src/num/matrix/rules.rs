//! Results of the units for one block: NVIDIA's adder and its variants, AMD's CDNA1 to CDNA3, and fused multiply-adds.

use super::element::{Element, ResultFormat, Value, special};
use crate::num::aligned::{Addend, Alignment, aligned};
use crate::num::{Denormals, DotOrder, Format, ops};

/// NVIDIA: addends are aligned to the largest exponent, truncated to `bits` bits below it, and added exactly.
pub(super) fn adder(addends: &[Value], bits: u32, least: i32, result: ResultFormat) -> u64 {
    if let Some(value) = special(addends.iter().copied()) {
        return result.special(value);
    }
    sum(addends.iter().filter_map(|value| value.addend()), bits, least, result)
}

fn sum(addends: impl Iterator<Item = Addend> + Clone, bits: u32, least: i32, result: ResultFormat) -> u64 {
    let sum = aligned(addends, bits, Some(least), Alignment::Cut);
    result.round(sum.sum < 0, sum.sum.unsigned_abs(), sum.top - bits.cast_signed())
}

/// `mma.sync` with FP8 on Hopper and data-center Blackwell: two aligned sums. The first adds zero and the products
/// whose index modulo 4 is 0 or 1; the second adds that result and the other products. An ordinary addition, to nearest
/// even, then adds `c`. NaN, infinities and zeros have not been measured.
pub(super) fn synchronous(products: &[Value], c: u64, bits: u32, least: i32, result: ResultFormat) -> u64 {
    let element = result.element;
    let half = |which: usize, sum: u64| {
        let mine = products.iter().enumerate().filter(|(k, _)| k % 4 / 2 == which).map(|(_, product)| *product);
        adder(&mine.chain([element.decode(sum)]).collect::<Vec<_>>(), bits, least, result)
    };
    let format = element.format.unwrap_or(Format::FP32);
    let total = ops::add(format, half(1, half(0, 0)) as u32, c as u32).bits;
    if format.is_nan(total) { result.special(Value::Nan) } else { total.into() }
}

/// Products per group.
pub(super) const GROUP: usize = 16;
/// Least exponent of the sum of four groups.
const GROUPS_LEAST: i32 = -139;

/// One block of 64 products in four groups of 16, each with its pair of scales. The products of a group are added
/// exactly. The group's exponent is the exponent of its scales, and counts even if the products cancel.
pub(super) fn groups(products: &[Value], scales: &[[Value; 2]], c: Value, bits: u32, result: ResultFormat) -> u64 {
    if let Some(value) = special(scales.iter().flatten().copied().chain([c])) {
        return result.special(value);
    }
    let groups = products.chunks(GROUP).zip(scales).filter_map(|(products, scales)| group(products, *scales));
    sum(groups.chain(c.addend()), bits, GROUPS_LEAST, result)
}

/// The addend of a group; `None` if all its products, or a scale, are zero.
fn group(products: &[Value], [sa, sb]: [Value; 2]) -> Option<Addend> {
    let scale = sa.times(sb).addend()?;
    let products: Vec<Addend> = products.iter().filter_map(|product| product.addend()).collect();
    let fraction = products.first()?.fraction;
    // Magnitudes are below 6 * 6, in units of 1/4.
    let quarters = |p: &Addend| (p.magnitude << p.exponent).cast_signed() * if p.negative { -1 } else { 1 };
    let sum: i64 = products.iter().map(quarters).sum();
    Some(Addend {
        negative: sum < 0,
        magnitude: sum.unsigned_abs() * scale.magnitude,
        exponent: scale.exponent,
        fraction: fraction + scale.fraction,
    })
}

/// A value as a word of single precision, which represents every type except fp64.
fn single(value: Value) -> u32 {
    let result = ResultFormat::NEAREST32;
    match value {
        Value::Finite(Addend { negative, magnitude: 0, .. }) => u32::from(negative) << 31,
        Value::Finite(x) => result.round(x.negative, x.magnitude.into(), x.exponent - x.fraction.cast_signed()) as u32,
        other => result.special(other) as u32,
    }
}

/// CDNA1: the exact sum of a block, rounded once. An exact zero is +0.
pub(super) fn exact(x: &[Value], y: &[Value], c: u64) -> u64 {
    let products = x.iter().zip(y).map(|(&x, &y)| (single(x), single(y)));
    let terms: Vec<(u32, u32)> = products.chain([(c as u32, Format::FP32.one()), (0, 0)]).collect();
    ops::dot(Format::FP32, DotOrder::Exact, &terms).bits.into()
}

/// CDNA2: operations of single precision that flush subnormal results, in pairs. A zero keeps its sign between the
/// blocks of an instruction, but not as the `c` of the first block.
pub(super) fn pairs(x: &[Value], y: &[Value], block: usize, c: Value, is_first: bool) -> u64 {
    let format = Format::FP32.with_denormals(Denormals::Flush);
    // Operands that are subnormal in their own type become +0, as zeros do.
    let word = |value: Value| match value {
        Value::Finite(x) if x.magnitude >> x.fraction == 0 => 0,
        other => single(other),
    };
    let product = |k: usize| match (x.get(k), y.get(k)) {
        (Some(&x), Some(&y)) => ops::mul(format, word(x), word(y)).bits,
        _ => 0,
    };
    let add = |x: u32, y: u32| ops::add(format, x, y).bits;
    let mut sum = add(product(0), product(1));
    if block == 4 {
        sum = add(sum, add(product(2), product(3)));
    }
    add(if is_first { word(c) } else { single(c) }, sum).into()
}

/// `fma(a, b, c)`: the exact value, rounded once; signs of zeros as in IEEE 754.
#[expect(clippy::disallowed_methods, reason = "the unit rounds once")]
pub(super) fn fused(a: u64, b: u64, c: u64, element: Element) -> u64 {
    if element == Element::FP32 {
        return ops::fused_mad(Format::FP32, a as u32, b as u32, c as u32).bits.into();
    }
    // IEEE 754 defines the result, except for the bits of NaN.
    let [a, b, c] = [a, b, c].map(f64::from_bits);
    let sum = a.mul_add(b, c);
    if sum.is_nan() { 0x7ff8 << 48 } else { sum.to_bits() }
}

/// Bits below the largest exponent that CDNA3 keeps of products and of `c`.
const KEPT: u32 = 24;
/// Bits that CDNA3 keeps of the sum of products, below the larger exponent of this sum and `c`.
const SUM_KEPT: i32 = 32;

/// CDNA3: products are aligned and truncated; their sum and `c` are aligned and rounded down. With `halves` (FP8),
/// products of even and of odd index are summed separately.
pub(super) fn floored(products: &[Value], c: Value, halves: bool) -> u64 {
    let result = ResultFormat::NEAREST32;
    let limited = products.iter().map(|&product| if halves { product } else { overflowing(product) });
    if let Some(value) = special(limited.chain([c])) {
        return result.special(value);
    }
    let Value::Finite(c) = c else { return 0 };
    let side = |parity: usize| -> Vec<Addend> {
        let mine = products.iter().enumerate().filter(|(k, _)| !halves || k % 2 == parity);
        mine.filter_map(|(_, product)| product.addend()).collect()
    };
    let sides = (0..1 + usize::from(halves)).map(side).filter(|side| !side.is_empty());
    let sums: Vec<_> = sides.map(|side| aligned(side, KEPT, None, Alignment::Cut)).collect();
    let least = Format::FP32.exponents().0;
    let c_exponent = if c.magnitude == 0 { least } else { c.exponent };
    let products_top = sums.iter().map(|sum| sum.top).max();
    let top = products_top.map_or(c_exponent, |t| t.max(c_exponent));
    let floor = |value: i128, by: i32| value >> by.clamp(0, 127);
    let together: i128 = sums.iter().map(|sum| floor(sum.sum, products_top.unwrap_or(0) - sum.top)).sum();
    // From here on, sums are in units of 2^(top - 32).
    let finer = SUM_KEPT - KEPT.cast_signed();
    let u = floor(together << finer, top - products_top.unwrap_or(top));
    let is_left_out = c.magnitude == 0 || halves && c_exponent < top - 25;
    let v = if is_left_out { 0 } else { aligned([c], KEPT, Some(top), Alignment::Floor).sum << finer };
    let (sum, exponent) = (u + v, top - SUM_KEPT);
    let leading = sum.unsigned_abs().checked_ilog2().unwrap_or(0).cast_signed() + exponent;
    let dropped = (leading.max(least) - 31 - exponent).max(0);
    let kept = floor(sum, dropped);
    result.round(kept < 0, kept.unsigned_abs(), exponent + dropped)
}

/// Replaces a product of `2^128` or more by an infinity.
fn overflowing(product: Value) -> Value {
    match product.addend() {
        Some(x) if x.magnitude.ilog2().cast_signed() + x.exponent - x.fraction.cast_signed() >= 128 => {
            Value::Infinite { negative: x.negative }
        }
        _ => product,
    }
}
