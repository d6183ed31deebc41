//! NVIDIA: products and the addend are aligned to the largest exponent, cut, and added exactly.

use super::element::{Element, Value, special};
use super::result::ResultFormat;
use crate::num::aligned::{Addend, Alignment, aligned};
use crate::num::{Format, ops};

/// Bits that are kept, and least exponent, of the sum of four groups.
const GROUPS_LEAST: i32 = -139;
/// Products of a group.
const GROUP: usize = 16;

/// One block: the sum of products and `c`, of which `bits` bits below the largest exponent are kept.
pub(super) fn block(products: &[Value], c: Value, bits: u32, least: i32, result: ResultFormat) -> u64 {
    let addends = || products.iter().copied().chain([c]);
    match special(addends()) {
        Some(value) => result.special(value),
        None => sum(&addends().filter_map(Value::addend).collect::<Vec<_>>(), bits, least, result),
    }
}

fn sum(addends: &[Addend], bits: u32, least: i32, result: ResultFormat) -> u64 {
    let sum = aligned(addends.iter().copied(), bits, Some(least), Alignment::Cut);
    result.round(sum.sum < 0, sum.sum.unsigned_abs(), sum.top - bits.cast_signed())
}

/// `mma.sync` with FP8 on Hopper and data-center Blackwell: two blocks of the products whose index modulo 4 is 0 or 1,
/// then 2 or 3, the first with zero, the second with its result; `c` is added by an ordinary addition, to nearest even.
/// NaN, infinities and zeros of this form have not been measured.
pub(super) fn synchronous(products: &[Value], c: u64, bits: u32, least: i32, result: ResultFormat) -> u64 {
    let half = |which: usize| -> Vec<Value> {
        products.iter().enumerate().filter(|(k, _)| k % 4 / 2 == which).map(|(_, product)| *product).collect()
    };
    let element = result.element();
    let first = block(&half(0), element.decode(0), bits, least, result);
    let second = block(&half(1), element.decode(first), bits, least, result);
    let format = if element == Element::FP16 { Format::FP16 } else { Format::FP32 };
    let total = u64::from(ops::add(format, second as u32, c as u32).bits);
    if element.decode(total) == Value::Nan { result.special(Value::Nan) } else { total }
}

/// The pair of scales of a group.
pub(super) type GroupScales = (Value, Value);

/// One block of 64 products in four groups of 16, each with its pair of scales. The products of a group are added
/// exactly; its exponent is that of its scales, and counts even if they cancel.
pub(super) fn groups(products: &[Value], scales: &[GroupScales], c: Value, bits: u32, result: ResultFormat) -> u64 {
    let all = scales.iter().flat_map(|pair| [pair.0, pair.1]);
    if let Some(value) = special(all.chain([c])) {
        return result.special(value);
    }
    let mut addends: Vec<Addend> = products.chunks(GROUP).zip(scales).filter_map(|(p, s)| group(p, *s)).collect();
    addends.extend(c.addend());
    sum(&addends, bits, GROUPS_LEAST, result)
}

/// The addend of a group; none if all its products, or a scale, are zero.
fn group(products: &[Value], (sa, sb): GroupScales) -> Option<Addend> {
    let scale = sa.times(sb).addend()?;
    let products: Vec<Addend> = products.iter().filter_map(|product| product.addend()).collect();
    // Magnitudes are below 6 * 6, in quarters.
    let quarters = |p: &Addend| {
        let size = (p.magnitude << p.exponent).cast_signed();
        if p.negative { -size } else { size }
    };
    let fraction = products.first()?.fraction;
    let sum: i64 = products.iter().map(quarters).sum();
    Some(Addend {
        negative: sum < 0,
        magnitude: sum.unsigned_abs() * scale.magnitude,
        exponent: scale.exponent,
        fraction: fraction + scale.fraction,
    })
}
