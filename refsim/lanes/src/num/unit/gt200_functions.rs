//! Functions of GT200: quadratic interpolation in tables of 64 or 128 rows.

use super::tables::{GT200_EX2, GT200_LG2, GT200_RCP, GT200_RSQRT, GT200_SIN};
use super::word::{INFINITY, NAN, SIGN, Word, assemble, cut, cut_signed, signed};

/// Bit 30 of a prepared word: set for NaN and infinity.
const PREPARED_SPECIAL: u32 = 0x4000_0000;

/// The square of the 17-bit `y`, in units of `2^17`, from individually truncated partial products.
fn square(y: u32) -> i64 {
    let sum: u32 = (0..17).filter(|i| y >> i & 1 != 0).map(|i| y >> (18 - i)).sum();
    i64::from(sum >> 1)
}

/// Assembles a result from its interpolated significand, 2^23 to 2^24.
fn finish(negative: bool, field: i32, significand: i64) -> u32 {
    let (field, mantissa) = match significand {
        0x100_0000 => (field + 1, 0),
        _ => (field, significand as u32 & 0x7f_ffff),
    };
    match field {
        ..=0 => signed(negative, 0),
        255.. => signed(negative, INFINITY),
        _ => assemble(negative, field, mantissa),
    }
}

/// RCP: `1 / x`.
pub fn rcp(x: u32) -> u32 {
    let word = Word::of(x);
    match word.field {
        _ if word.is_nan() => return NAN,
        0 => return signed(word.negative, INFINITY),
        255 => return signed(word.negative, 0),
        _ => {}
    }
    let (r, [a, b, c]) = (word.bits(0, 16) as u32, GT200_RCP[word.bits(16, 7)]);
    let significand = ((a << 13) + b * i64::from(r) + c * square(2 * r) + 18407) >> 15;
    finish(word.negative, 253 - word.field, significand)
}

/// RSQRT: `1 / sqrt(x)`.
pub fn rsq(x: u32) -> u32 {
    let word = Word::of(x);
    match word.field {
        _ if word.is_nan() => return NAN,
        0 => return signed(word.negative, INFINITY),
        _ if word.negative => return NAN,
        255 => return 0,
        _ => {}
    }
    let exponent = word.field - 127;
    let fraction = word.mantissa | ((exponent & 1) << 23).cast_unsigned();
    let half = exponent >> 1;
    if fraction == 0 {
        return assemble(false, 127 - half, 0);
    }
    let (r, [a, b, c]) = (fraction & 0x1_ffff, GT200_RSQRT[(fraction >> 17) as usize]);
    let significand = ((a << 14) + b * i64::from(r) + 4 * c * square(r) + 32767) >> 16;
    finish(false, 126 - half, significand)
}

/// LG2: `log2 x`.
pub fn lg2(x: u32) -> u32 {
    let word = Word::of(x);
    match word.field {
        _ if word.is_nan() => return NAN,
        0 => return INFINITY | SIGN,
        _ if word.negative => return NAN,
        255 => return INFINITY,
        _ => {}
    }
    let (r, [a, b, c]) = (word.bits(0, 17) as u32, GT200_LG2[word.bits(17, 6)]);
    // 1.0 is the only power of two whose result is exact.
    let fraction = match (word.mantissa, word.field) {
        (0, 127) => 0,
        _ => ((a << 12) + b * i64::from(r) + 2 * c * square(r) + 13125) >> 2,
    };
    cut_signed(fraction + (i64::from(word.field - 127) << 36), 36)
}

/// PRESIN: prepares an angle in radians as sign, bit 30 (set for NaN and infinity), and quarter turns in units of
/// `2^-23`.
pub fn presin(x: u32) -> u32 {
    let word = Word::of(x);
    match word.field {
        _ if word.is_nan() => return signed(word.negative, PREPARED_SPECIAL),
        255 => return signed(word.negative, PREPARED_SPECIAL | 0x80_0000),
        0 => return signed(word.negative, 0),
        _ => {}
    }
    // 2 / pi in units of 2^-24.
    let turns = (word.significand() * 0xa2_f983) >> 16;
    let turns = match word.field - 135 {
        32.. => 0,
        left @ 0.. => turns << left,
        right => turns >> right.unsigned_abs().min(63),
    };
    signed(word.negative, turns as u32 & 0x1ff_ffff)
}

/// SIN of a prepared word.
pub fn sin_prepared(p: u32) -> u32 {
    circular(p, p >> 23 & 0xff, p & SIGN != 0)
}

/// COS of a prepared word.
pub fn cos_prepared(p: u32) -> u32 {
    circular(p, (p >> 23 & 0xff) + 1, false)
}

/// The sine of `quarter` quarter turns plus the fraction in the low 23 bits of `p`.
fn circular(p: u32, quarter: u32, negative: bool) -> u32 {
    if p & PREPARED_SPECIAL != 0 {
        return NAN;
    }
    let fraction = p & 0x7f_ffff;
    let fraction = if quarter & 1 != 0 { 0x7f_ffff - fraction } else { fraction };
    let negative = negative != (quarter & 2 != 0);
    let (r, [a, b, c]) = (fraction & 0x1_ffff, GT200_SIN[(fraction >> 17) as usize]);
    let value = (a << 11) + b * i64::from(r) + c * square(r);
    cut(negative, value.unsigned_abs(), 37)
}

/// `sin x`, radians: PRESIN, then SIN.
pub fn sin(x: u32) -> u32 {
    sin_prepared(presin(x))
}

/// `cos x`, radians: PRESIN, then COS.
pub fn cos(x: u32) -> u32 {
    cos_prepared(presin(x))
}

/// PREEX2: prepares a number as sign, bit 30 (set if out of range), and a magnitude in units of `2^-23`.
pub fn preex2(x: u32) -> u32 {
    let word = Word::of(x);
    match word.field {
        _ if word.is_nan() => return signed(word.negative, PREPARED_SPECIAL),
        134.. => return signed(word.negative, PREPARED_SPECIAL | 0x80_0000),
        0 => return signed(word.negative, 0),
        _ => {}
    }
    let magnitude = word.significand();
    let fixed = match word.field - 127 {
        left @ 0.. => magnitude << left,
        right => magnitude >> right.unsigned_abs().min(63),
    };
    // Below 2^30.
    signed(word.negative, fixed as u32)
}

/// EX2 of a prepared word.
pub fn ex2_prepared(p: u32) -> u32 {
    let (negative, mut fraction) = (p & SIGN != 0, p & 0x7f_ffff);
    let mut whole = (p >> 23 & 0xff).cast_signed();
    if p & PREPARED_SPECIAL != 0 {
        return match (whole % 2, negative) {
            (0, _) => NAN,
            (_, true) => 0,
            (_, false) => INFINITY,
        };
    }
    if negative && fraction > 0 {
        (whole, fraction) = (-whole - 1, 0x7f_ffff - fraction);
    } else if negative {
        whole = -whole;
    }
    let (r, [a, b, c]) = (fraction & 0x1_ffff, GT200_EX2[(fraction >> 17) as usize]);
    let significand = ((a << 13) + b * i64::from(r) + c * square(r) + 30690) >> 15;
    finish(false, whole + 127, significand)
}

/// `2^x`: PREEX2, then EX2.
pub fn ex2(x: u32) -> u32 {
    ex2_prepared(preex2(x))
}
