//! Functions of the vertex units: tables and integer steps of Newton's method, and the quadratic interpolator of NV3x.

use super::tables::{NV_EXP, NV_LOG, NV_RCP, NV_RSQ, NV3X_EX2, NV3X_LG2, NV3X_SINCOS, NV3X_SINCOS_MULTIPLIER};
use super::word::{INFINITY, NAN, ONE, SIGN, Word, assemble, cut, cut_signed, signed};
use crate::num::rules::Unit;

/// The 23 bits below the leading one of a value from 2^23 up to 2^24.
const fn below_leading(value: i64) -> u32 {
    (value - (1 << 23)) as u32 & 0x7f_ffff
}

/// Exponent field and mantissa of the reciprocal of a finite number, or of infinity; the exponent field may be below 1.
fn reciprocal(x: Word) -> (i32, u32) {
    if x.mantissa == 0 {
        return (254 - x.field, 0);
    }
    let f = x.significand().cast_signed();
    let [mut a] = NV_RCP[x.bits(17, 6)];
    a = (((1 << 31) - a * f) * a) >> 24;
    a = (((1 << 37) - a * f) * a) >> 25;
    (253 - x.field, below_leading(a))
}

/// RCP: `1 / x`.
pub fn rcp(x: u32) -> u32 {
    let word = Word::of(x);
    if word.is_nan() {
        return NAN;
    }
    if word.is_zero() {
        return signed(word.negative, INFINITY);
    }
    match reciprocal(word) {
        (..=0, _) => signed(word.negative, 0),
        (field, mantissa) => assemble(word.negative, field, mantissa),
    }
}

/// RCC: `1 / x`, its magnitude clamped to `2^-64` to `2^64`.
pub fn rcc(x: u32) -> u32 {
    const LEAST: u32 = 0x1f80_0000;
    const MOST: u32 = 0x5f80_0000;
    let word = Word::of(x);
    if word.is_nan() {
        return NAN;
    }
    if word.is_zero() {
        return signed(word.negative, MOST);
    }
    match reciprocal(word) {
        (..63, _) => signed(word.negative, LEAST),
        (191.., _) => signed(word.negative, MOST),
        (field, mantissa) => assemble(word.negative, field, mantissa),
    }
}

/// RSQ: `1 / sqrt(x)`; in legacy programs, of the magnitude.
pub fn rsq(unit: Unit, x: u32) -> u32 {
    let word = Word::of(x);
    let negative = word.negative && unit == Unit::Nv3x;
    match word {
        _ if word.is_nan() => return NAN,
        _ if word.is_zero() => return signed(negative, INFINITY),
        _ if negative => return NAN,
        _ if word.is_infinite() => return 0,
        _ => {}
    }
    let (odd, f) = (word.field % 2 != 0, word.significand().cast_signed());
    // Significands in [1, 2), and in [2, 4).
    let (field, index, g) = if odd {
        (126 - (word.field - 127) / 2, word.bits(17, 6), f)
    } else {
        (126 - (word.field - 128) / 2, 64 + word.bits(17, 6), 2 * f)
    };
    if unit != Unit::Nv2x && odd && word.mantissa == 0 {
        return assemble(false, field + 1, 0);
    }
    let [mut a] = NV_RSQ[index];
    a = (((3 << 37) - a * a * g) * a) >> 32;
    // The product of three factors of up to 24, 24 and 25 bits exceeds 64 bits.
    let (wide, g) = (i128::from(a), i128::from(g));
    let root = (((3 << 49) - wide * wide * g) * wide) >> 39;
    assemble(false, field, below_leading(root as i64))
}

/// `floor(x 2^13)` as a saturated 32-bit integer; values below `2^-23` give 0, and NaN the largest.
fn fixed13(x: Word) -> i64 {
    match x.field {
        _ if x.is_nan() => i32::MAX.into(),
        145.. if x.negative => i32::MIN.into(),
        145.. => i32::MAX.into(),
        ..104 => 0,
        field => {
            let magnitude = x.significand().cast_signed();
            let value = if x.negative { -magnitude } else { magnitude };
            if field >= 137 { value << (field - 137) } else { value >> (137 - field) }
        }
    }
}

/// `2^(p / 2^13)`, by a table of 32 rows.
fn power13(p: i64) -> u32 {
    match p >> 13 {
        ..=-127 => 0,
        128.. => INFINITY,
        whole => {
            let [base, slope] = NV_EXP[(p >> 8 & 31) as usize];
            let fraction = 256 * base + slope * (p & 255);
            assemble(false, whole as i32 + 127, 2 * fraction as u32)
        }
    }
}

/// x of EXP: `2^floor(x)`; infinity for NaN.
pub fn exp_floor(x: u32) -> u32 {
    power13(fixed13(Word::of(x)) & !0x1fff)
}

/// y of EXP: `x - floor(x)`, exact except for small negative numbers; a NaN is returned unchanged.
pub fn exp_fraction(x: u32) -> u32 {
    let word = Word::of(x);
    match word.field {
        _ if word.is_nan() => return x,
        0 | 150.. => return 0,
        ..127 if !word.negative => return x,
        ..104 => return ONE,
        _ => {}
    }
    // In units of `2^(field - 150)`; a negative number above -1 is first rounded down to a multiple of 2^-23.
    let (magnitude, field) = match word.field {
        field @ ..127 => (word.significand().div_ceil(1 << (127 - field)), 127),
        field => (word.significand(), field),
    };
    let value = if word.negative { -magnitude.cast_signed() } else { magnitude.cast_signed() };
    let fraction = value & ((1 << (150 - field)) - 1);
    cut(false, fraction.cast_unsigned(), 150 - field)
}

/// z of EXP: `2^x`, to about 11 bits.
pub fn exp_power(x: u32) -> u32 {
    let word = Word::of(x);
    if word.is_nan() { NAN } else { power13(fixed13(word)) }
}

/// The components of LOG for NaN and, in modern programs, for negative operands.
fn log_special(unit: Unit, x: u32) -> Option<u32> {
    let word = Word::of(x);
    match unit {
        Unit::Nv3x if word.negative || word.is_nan() => Some(NAN),
        Unit::Nv2x if word.is_nan() => Some(x & !SIGN),
        _ if word.is_nan() => Some(NAN),
        _ => None,
    }
}

/// x of LOG: the exponent of `|x|`.
pub fn log_exponent(unit: Unit, x: u32) -> u32 {
    log_special(unit, x).unwrap_or_else(|| match Word::of(x).field {
        0 => INFINITY | SIGN,
        255 => INFINITY,
        field => cut(field < 127, (field - 127).unsigned_abs().into(), 0),
    })
}

/// y of LOG: the significand of `x`, in [1, 2).
pub fn log_mantissa(unit: Unit, x: u32) -> u32 {
    log_special(unit, x).unwrap_or_else(|| match Word::of(x) {
        Word { field: 0, .. } => ONE,
        word => ONE | word.mantissa,
    })
}

/// z of LOG: `log2 |x|`, to about 11 bits.
pub fn log_power(unit: Unit, x: u32) -> u32 {
    log_special(unit, x).unwrap_or_else(|| match Word::of(x) {
        Word { field: 0, .. } => INFINITY | SIGN,
        Word { field: 255, .. } => INFINITY,
        word => {
            let value = logarithm26(word);
            cut(value < 0, value.unsigned_abs(), 26)
        }
    })
}

/// `log2 |x|` in units of `2^-26`, by a table of 32 rows.
fn logarithm26(x: Word) -> i64 {
    let [base, slope] = NV_LOG[x.bits(18, 5)];
    256 * base + slope * i64::from(x.bits(10, 8) as u32) + (i64::from(x.field - 127) << 26)
}

/// y of LIT: `x`, or +0 if its sign is set.
pub fn lit_diffuse(x: u32) -> u32 {
    if Word::of(x).negative { 0 } else { x }
}

/// z of LIT: `x > 0 ? y^w : 0` by the tables of LOG and EXP, `w` clamped to -128 up to 128.
pub fn lit_specular(x: u32, y: u32, w: u32) -> u32 {
    let (x, y, w) = (Word::of(x), Word::of(y), Word::of(w));
    match () {
        () if x.negative || x.is_zero() => return 0,
        () if w.is_zero() => return ONE,
        () if y.is_nan() || w.is_nan() => return NAN,
        () if y.negative || y.is_zero() => return if w.negative { INFINITY } else { 0 },
        () if y.is_infinite() => return if w.negative { 0 } else { INFINITY },
        () => {}
    }
    let exponent = fixed13(w).clamp(-1 << 20, (1 << 20) - 1);
    match (logarithm26(y) * exponent) >> 26 {
        below if below < i32::MIN.into() => 0,
        above if above > i32::MAX.into() => INFINITY,
        power => power13(power),
    }
}

/// `v / 2^k`, to nearest, halves up; `k` is at least 1.
const fn half_up(v: i64, k: u32) -> i64 {
    (v + (1 << (k - 1))) >> k
}

/// The interpolator's square `r^2 / 2^14`, from individually rounded partial products.
fn square(r: i64) -> i64 {
    let q = r >> 7;
    let first = q * q + if r >> 6 & 1 != 0 { q } else { 0 };
    (0..6).filter(|i| r >> i & 1 != 0).map(|i| half_up(r, 13 - i)).sum::<i64>() + first
}

/// The interpolator's product `c r / 2^13`, from individually rounded partial products of Booth's recoding.
fn product(c: i64, r: i64) -> i64 {
    const DIGITS: [i64; 8] = [0, 1, 1, 2, -2, -1, -1, 0];
    let (mut value, mut rest, mut place) = (0, 2 * c, -14);
    while rest > 0 {
        let digit = DIGITS[(rest & 7) as usize];
        let shift: i32 = place + i32::from(digit.abs() == 2);
        let partial = if shift >= 0 { r << shift } else { half_up(r, shift.unsigned_abs()) };
        value += digit.signum() * partial;
        rest >>= 2;
        place += 2;
    }
    value
}

/// Interpolates at a 23-bit `x`; returns the table row, the product with the row's slope, and the square.
fn interpolate(table: &[[i64; 3]], x: u32) -> ([i64; 3], i64, i64) {
    let (mut t, mut r) = (x >> 16, i64::from(x & 0xffff));
    if t % 2 == 1 {
        (t, r) = (t + 1, r - 65536);
    }
    let row = table[(t / 2) as usize];
    (row, product(row[1], r), square(r))
}

/// The interpolator of LG2, SIN and COS, whose quadratic term is negative: units of `2^-38`.
fn concave(table: &[[i64; 3]], x: u32) -> i64 {
    let ([base, _, curve], linear, square) = interpolate(table, x);
    (base << 15) + (linear << 6) - ((curve * square + ((square - 1024) >> 12) + 32) >> 5)
}

/// The interpolator of EX2: units of `2^-38`.
fn convex(table: &[[i64; 3]], x: u32) -> i64 {
    let ([base, _, curve], linear, square) = interpolate(table, x);
    (base << 15) + (linear << 6) + ((curve * square) >> 5)
}

/// LG2 (NV3x): `log2 x`.
pub fn lg2(x: u32) -> u32 {
    match Word::of(x) {
        Word { field: 0, .. } => INFINITY | SIGN,
        word if word.is_nan() || word.negative => NAN,
        Word { field: 255, .. } => INFINITY,
        word => cut_signed(concave(&NV3X_LG2, word.mantissa) + (i64::from(word.field - 127) << 38), 38),
    }
}

/// EX2 (NV3x): `2^x`.
pub fn ex2(x: u32) -> u32 {
    let word = Word::of(x);
    match word.field {
        _ if word.is_nan() => return NAN,
        ..70 => return ONE,
        134.. => return if word.negative { 0 } else { INFINITY },
        _ => {}
    }
    // In units of 2^-23.
    let magnitude = word.significand().cast_signed();
    let magnitude =
        if word.field >= 127 { magnitude << (word.field - 127) } else { magnitude >> (127 - word.field).min(63) };
    let value = if word.negative { !magnitude } else { magnitude };
    let field = 127 + (value >> 23) as i32;
    if field <= 0 {
        return 0;
    }
    assemble(false, field, (convex(&NV3X_EX2, (value & 0x7f_ffff) as u32) >> 15) as u32)
}

/// SIN (NV3x), radians. Angles of `2^-31` to `2^-28` and above `2^35` are wrong, as on the card.
pub fn sin(x: u32) -> u32 {
    let word = Word::of(x);
    match word.field {
        255 => NAN,
        ..96 => 0,
        _ => wave(angle(word)),
    }
}

/// COS (NV3x), radians; wrong where [`sin`] is.
pub fn cos(x: u32) -> u32 {
    let word = Word::of(x);
    match word.field {
        255 => NAN,
        ..112 => ONE,
        _ => wave(angle(word) + (1 << 23)),
    }
}

/// An angle in units of `2^-25` turns, in one's complement below zero.
fn angle(x: Word) -> i64 {
    // 2^32 / (2 pi) in units of 2^-4, for the leading one; the table has the values for the other bits.
    let bits = (0..23).filter(|bit| x.mantissa >> bit & 1 != 0).map(|bit| NV3X_SINCOS_MULTIPLIER[bit][0]);
    let turns = (10_937_044_408 + bits.sum::<i64>()) >> 8;
    let shift = match x.field {
        226.. => x.field - 226,
        194.. => x.field - 194,
        162.. => x.field - 162,
        ..99 => x.field - 98,
        _ => x.field - 130,
    };
    let turns = if shift >= 0 { turns << shift } else { turns >> -shift };
    if x.negative { !turns } else { turns }
}

/// The sine of an angle in units of `2^-25` turns.
fn wave(angle: i64) -> u32 {
    let folded = if angle >> 23 & 1 != 0 { !angle } else { angle };
    let value = concave(&NV3X_SINCOS, (folded & 0x7f_ffff) as u32);
    cut(angle >> 24 & 1 != 0, value.unsigned_abs(), 38)
}
