//! Functions of GT200, one lane at a time: quadratic interpolation in tables.

use super::card::CardFunctions;
use super::gt200::Gt200;
use super::word::{
    FIELD, MANTISSA, NAN, SIGN, assembled, cut_complement, field, halved, is_nan, is_zero, significand, whole,
};
use crate::lanes::layout::pow2;
use crate::num::NumberOperation as Op;
use crate::num::unit::tables::{GT200_EX2, GT200_LG2};

impl CardFunctions for Gt200 {
    type Entry = [f64; 3];

    #[inline(always)]
    fn rcp_entry(&self, x: u32) -> [f64; 3] {
        self.tables.rcp[((x & MANTISSA) >> 16) as usize]
    }

    #[inline(always)]
    fn rcp(&self, x: u32, [a, b, c]: [f64; 3]) -> u32 {
        let (sign, e) = (x & SIGN, field(x));
        let r = x & 0xffff;
        let sum = a * pow2(13) + b * f64::from(r.cast_signed()) + c * squared(2 * r);
        let word = scaled(sign, 253 - e, whole(halved(sum + 18407.0, 15)));
        let word = if e == 255 { sign } else { word };
        let word = if e == 0 { sign | FIELD } else { word };
        if is_nan(x) { NAN } else { word }
    }

    #[inline(always)]
    fn rsq_entry(&self, x: u32) -> [f64; 3] {
        self.tables.rsq[(root_bits(x) >> 17) as usize]
    }

    #[inline(always)]
    fn rsq(&self, x: u32, [a, b, c]: [f64; 3]) -> u32 {
        let (sign, e) = (x & SIGN, field(x));
        let k = e - 127;
        let (f, r) = (root_bits(x), x & 0x1_ffff);
        let sum = a * pow2(14) + b * f64::from(r.cast_signed()) + 4.0 * c * squared(r);
        let one = f == 0;
        let significand = whole(halved(sum + 32767.0, 16));
        let word = scaled(0, 126 + i32::from(one) - (k >> 1), if one { 1 << 23 } else { significand });
        let word = if e == 255 { 0 } else { word };
        let word = if sign != 0 { NAN } else { word };
        let word = if e == 0 { sign | FIELD } else { word };
        if is_nan(x) { NAN } else { word }
    }

    #[inline(always)]
    fn function(&self, operation: Op, [a, b, _]: [u32; 3]) -> Option<u32> {
        Some(match operation {
            Op::Exp2 => exp2(a),
            Op::Log2 => log2(a),
            Op::Scale => self.scale(a, b.cast_signed()),
            _ => return None,
        })
    }
}

/// Input of RSQ without powers of 4: the mantissa, and the parity of the exponent.
#[inline(always)]
fn root_bits(x: u32) -> u32 {
    !x & 1 << 23 | x & MANTISSA
}

/// The squarer: each partial product is truncated.
#[inline(always)]
fn square(y: u32) -> u32 {
    let mut sum = 0;
    for i in 0..17 {
        sum += if y >> i & 1 == 1 { y >> (18 - i) } else { 0 };
    }
    sum >> 1
}

#[inline(always)]
fn squared(y: u32) -> f64 {
    f64::from(square(y).cast_signed())
}

/// Assembles a result from an exponent field and a significand, 2^23 to 2^24.
#[inline(always)]
fn scaled(sign: u32, field: i32, significand: u32) -> u32 {
    assembled(sign, field + (significand >> 24).cast_signed(), significand)
}

fn log2(x: u32) -> u32 {
    if is_nan(x) {
        return NAN;
    }
    if is_zero(x) {
        return FIELD | SIGN;
    }
    if x & SIGN != 0 {
        return NAN;
    }
    if field(x) == 255 {
        return FIELD;
    }
    let (m, e) = (x & MANTISSA, field(x));
    let (r, [a, b, c]) = (m & 0x1_ffff, GT200_LG2[(m >> 17) as usize]);
    let fraction = match (m, e) {
        (0, 127) => 0,
        _ => (a * (1 << 12) + b * i64::from(r) + 2 * c * i64::from(square(r)) + 13125) >> 2,
    };
    cut_complement(fraction + (i64::from(e) - 127) * (1 << 36), 36)
}

/// EX2 after its preparation.
fn exp2(x: u32) -> u32 {
    let (e, negative) = (field(x), x & SIGN != 0);
    if is_nan(x) {
        return NAN;
    }
    if e >= 134 {
        return if negative { 0 } else { FIELD };
    }
    // In units of 2^-23.
    let distance = e - 127;
    let f = significand(x);
    let whole = match distance {
        _ if e == 0 => 0,
        0.. => f << distance,
        _ => f >> distance.unsigned_abs().min(31),
    };
    let (mut q, mut f) = ((whole >> 23).cast_signed(), whole & MANTISSA);
    if negative {
        (q, f) = if f > 0 { (!q, MANTISSA - f) } else { (-q, 0) };
    }
    let (r, [a, b, c]) = (f & 0x1_ffff, GT200_EX2[(f >> 17) as usize]);
    scaled(0, q + 127, ((a * (1 << 13) + b * i64::from(r) + c * i64::from(square(r)) + 30690) >> 15) as u32)
}
