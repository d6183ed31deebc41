//! Functions of GT200, one lane at a time: quadratic interpolation in tables.

use super::card::CardFunctions;
use super::gt200::Gt200;
use super::word::{FIELD, MANTISSA, NAN, SIGN, cut_complement, field, is_nan, is_zero, significand};
use crate::num::NumberOperation as Op;
use crate::num::unit::tables::{GT200_EX2, GT200_LG2, GT200_RCP, GT200_RSQRT};

impl CardFunctions for Gt200 {
    #[inline(always)]
    fn function(&self, operation: Op, [a, b, _]: [u32; 3]) -> Option<u32> {
        Some(match operation {
            Op::Rcp => rcp(a),
            Op::Rsq => rsq(a),
            Op::Exp2 => exp2(a),
            Op::Log2 => log2(a),
            Op::Scale => self.scale(a, b.cast_signed()),
            _ => return None,
        })
    }
}

/// The squarer: each partial product is cut.
fn square(y: u32) -> i64 {
    let y = i64::from(y);
    (0..17).filter(|i| y >> i & 1 == 1).map(|i| y >> (18 - i)).sum::<i64>() >> 1
}

/// A result of an exponent field and a significand, 2^23 to 2^24.
fn scaled(sign: u32, field: i32, significand: i64) -> u32 {
    let field = field + (significand >> 24) as i32;
    match field {
        ..=0 => sign,
        255.. => sign | FIELD,
        _ => sign | field.cast_unsigned() << 23 | significand as u32 & MANTISSA,
    }
}

/// RCP.
fn rcp(x: u32) -> u32 {
    let (sign, m) = (x & SIGN, x & MANTISSA);
    match field(x) {
        0 => sign | FIELD,
        255 => {
            if is_nan(x) {
                NAN
            } else {
                sign
            }
        }
        e => {
            let (r, [a, b, c]) = (m & 0xffff, GT200_RCP[(m >> 16) as usize]);
            scaled(sign, 253 - e, (a * (1 << 13) + b * i64::from(r) + c * square(2 * r) + 18407) >> 15)
        }
    }
}

/// RSQRT.
fn rsq(x: u32) -> u32 {
    if is_nan(x) {
        return NAN;
    }
    if is_zero(x) {
        return x & SIGN | FIELD;
    }
    if x & SIGN != 0 {
        return NAN;
    }
    if field(x) == 255 {
        return 0;
    }
    let k = field(x) - 127;
    let f = x & MANTISSA | (k & 1).cast_unsigned() << 23;
    let k = k >> 1;
    if f == 0 {
        return scaled(0, 127 - k, 1 << 23);
    }
    let (r, [a, b, c]) = (f & 0x1_ffff, GT200_RSQRT[(f >> 17) as usize]);
    scaled(0, 126 - k, (a * (1 << 14) + b * i64::from(r) + 4 * c * square(r) + 32767) >> 16)
}

/// LG2.
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
    let fraction = match m {
        0 => 0,
        _ => (a * (1 << 12) + b * i64::from(r) + 2 * c * square(r) + 13125) >> 2,
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
    scaled(0, q + 127, (a * (1 << 13) + b * i64::from(r) + c * square(r) + 30690) >> 15)
}
