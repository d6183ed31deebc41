//! Functions of the vertex unit of NV20 to NV35, one lane at a time.

use super::card::{CardFunctions, CardUnit};
use super::nv::Nv;
use super::word::{
    FIELD, MANTISSA, NAN, ONE, SIGN, assembled, cut, cut_complement, field, halved, is_nan, is_zero, significand, whole,
};
use crate::lanes::layout::pow2;
use crate::num::NumberOperation as Op;
use crate::num::unit::tables::{NV_EXP, NV_LOG, NV3X_EX2, NV3X_LG2};

/// Doubles represent the integers of Newton's method exactly, except one product.
impl CardFunctions for Nv {
    type Entry = [f64; 1];

    #[inline(always)]
    fn rcp_entry(&self, x: u32) -> [f64; 1] {
        self.tables.rcp[((x & MANTISSA) >> 17) as usize]
    }

    #[inline(always)]
    fn rcp(&self, x: u32, [a]: [f64; 1]) -> u32 {
        let (sign, e, m) = (x & SIGN, field(x), x & MANTISSA);
        let f = f64::from(significand(x).cast_signed());
        let a = halved((pow2(31) - a * f) * a, 24);
        let a = halved((pow2(37) - a * f) * a, 25);
        let power = m == 0;
        let word = assembled(sign, 253 - e + i32::from(power), if power { 0 } else { whole(a) });
        let word = if e == 0 { sign | FIELD } else { word };
        if is_nan(x) { NAN } else { word }
    }

    #[inline(always)]
    fn rsq_entry(&self, x: u32) -> [f64; 1] {
        // Table index: the inverted lowest bit of the exponent field, then the upper bits of the mantissa.
        self.tables.rsq[((!x & 1 << 23 | x & MANTISSA) >> 17) as usize]
    }

    #[inline(always)]
    fn rsq(&self, x: u32, [a]: [f64; 1]) -> u32 {
        let sign = if self.modern { x & SIGN } else { 0 };
        let (e, m) = (field(x), x & MANTISSA);
        // Computes the reciprocal root of half the significand, which is in [1, 4).
        let even = 1 - (e & 1);
        let g = f64::from((significand(x) << even).cast_signed());
        let a = halved((3.0 * pow2(37) - a * a * g) * a, 32);
        // The product has 64 bits: its low bits are added separately.
        let factor = 3.0 * pow2(49) - a * a * g;
        let high = halved(factor, 20);
        let low = halved((factor - high * pow2(20)) * a, 20);
        let a = halved(high * a + low, 19);
        let power = !self.is_2x & (even == 0) & (m == 0);
        let field = 126 - ((e - 127 - even) >> 1);
        let word = assembled(0, field + i32::from(power), if power { 0 } else { whole(a) });
        let word = if e == 255 { 0 } else { word };
        let word = if e == 0 { sign | FIELD } else { word };
        if is_nan(x) | (sign != 0) & (e != 0) { NAN } else { word }
    }

    #[inline(always)]
    fn function(&self, operation: Op, [a, b, c]: [u32; 3]) -> Option<u32> {
        Some(match operation {
            Op::Exp2 if !self.is_2x => Self::exp2(a),
            Op::Log2 if !self.is_2x => Self::log2(a),
            Op::ExpFloor => Self::exp_floor(a),
            Op::ExpFraction => Self::exp_fraction(a),
            Op::ExpPower => Self::exp_power(a),
            Op::LogExponent => self.log_exponent(a),
            Op::LogMantissa => self.log_mantissa(a),
            Op::LogPower => self.log_power(a),
            Op::LitDiffuse => Self::lit_diffuse(a),
            Op::LitSpecular => Self::lit_specular(a, b, c),
            Op::Sign if self.unordered(a, 0) => NAN,
            Op::Sign if self.same(a, 0) => 0,
            Op::Sign => ONE | if self.below(a, 0) { SIGN } else { 0 },
            _ => return None,
        })
    }
}

/// A normal number from its sign, exponent field and mantissa; an exponent field that is too small gives zero.
fn normal(sign: u32, field: i32, mantissa: i64) -> u32 {
    if field <= 0 { sign } else { sign | field.cast_unsigned() << 23 | mantissa as u32 & MANTISSA }
}

/// Exponent p of EXP and LIT: `x` in units of 2^-13, rounded down and clamped to 32 bits.
fn in_8192ths(x: u32) -> i64 {
    let (e, negative) = (field(x), x & SIGN != 0);
    match e {
        255 if is_nan(x) => i64::from(i32::MAX),
        145.. => i64::from(if negative { i32::MIN } else { i32::MAX }),
        ..104 => 0,
        _ => {
            let f = i64::from(significand(x));
            // x 2^13 is f 2^(e - 137).
            let f = if negative { -f } else { f };
            if e >= 137 { f << (e - 137) } else { f >> (137 - e) }
        }
    }
}

/// `2^(p / 8192)`
fn power(p: i64) -> u32 {
    let exponent = p >> 13;
    if exponent <= -127 {
        return 0;
    }
    if exponent >= 128 {
        return FIELD;
    }
    let [base, slope] = NV_EXP[(p >> 8 & 31) as usize];
    normal(0, exponent as i32 + 127, 2 * (256 * base + slope * (p & 255)))
}

/// The logarithm of a normal number's magnitude in units of 2^-26.
fn logarithm(x: u32) -> i64 {
    let m = x & MANTISSA;
    let [base, slope] = NV_LOG[(m >> 18) as usize];
    256 * base + slope * i64::from(m >> 10 & 255) + (i64::from(field(x)) - 127) * (1 << 26)
}

/// Converts an integer in units of `2^-bits` to a float, truncated to 24 bits.
fn cut_signed(value: i64, bits: i32) -> u32 {
    if value == 0 { 0 } else { cut(value < 0, value.unsigned_abs(), bits) }
}

impl Nv {
    /// Result component x of EXP.
    fn exp_floor(x: u32) -> u32 {
        power(in_8192ths(x) & !8191)
    }

    /// Result component y of EXP.
    fn exp_fraction(x: u32) -> u32 {
        let (e, negative) = (field(x), x & SIGN != 0);
        if is_nan(x) {
            return x;
        }
        match e {
            0 | 150.. => return 0,
            ..127 if !negative => return x,
            ..104 => return ONE,
            _ => {}
        }
        let f = u64::from(significand(x));
        // In units of 2^(e - 150); numbers below 1 have the unit of 1.
        let units = if e < 127 { f.div_ceil(1 << (127 - e)) } else { f };
        let bits = 150 - e.max(127);
        let whole = 1u64 << bits;
        let rest = if negative { units.wrapping_neg() } else { units } & (whole - 1);
        if rest == 0 { 0 } else { cut(false, rest, bits) }
    }

    /// Result component z of EXP.
    fn exp_power(x: u32) -> u32 {
        if is_nan(x) { NAN } else { power(in_8192ths(x)) }
    }

    /// The result of LOG for NaN, infinity and zero; `None` for other operands.
    fn log_of_none(self, x: u32) -> Option<u32> {
        match (self.modern && x & SIGN != 0, is_nan(x)) {
            (true, _) => Some(NAN),
            (_, true) => Some(if self.is_2x { x & !SIGN } else { NAN }),
            _ => None,
        }
    }

    /// Result component x of LOG.
    fn log_exponent(self, x: u32) -> u32 {
        self.log_of_none(x).unwrap_or_else(|| match field(x) {
            0 => FIELD | SIGN,
            255 => FIELD,
            e => cut_signed(i64::from(e) - 127, 0),
        })
    }

    /// Result component y of LOG.
    fn log_mantissa(self, x: u32) -> u32 {
        let of_number = || if is_zero(x) { ONE } else { ONE | x & MANTISSA };
        self.log_of_none(x).unwrap_or_else(of_number)
    }

    /// Result component z of LOG.
    fn log_power(self, x: u32) -> u32 {
        self.log_of_none(x).unwrap_or_else(|| match field(x) {
            0 => FIELD | SIGN,
            255 => FIELD,
            _ => cut_signed(logarithm(x), 26),
        })
    }

    /// Result component y of LIT.
    fn lit_diffuse(x: u32) -> u32 {
        if x & SIGN == 0 { x } else { 0 }
    }

    /// Result component z of LIT.
    fn lit_specular(x: u32, y: u32, w: u32) -> u32 {
        let (negative_w, finished) = (w & SIGN != 0, |infinite: bool| if infinite { FIELD } else { 0 });
        if x & SIGN != 0 || is_zero(x) {
            return 0;
        }
        if is_zero(w) {
            return ONE;
        }
        if is_nan(y) || is_nan(w) {
            return NAN;
        }
        if y & SIGN != 0 || is_zero(y) {
            return finished(negative_w);
        }
        if y == FIELD {
            return finished(!negative_w);
        }
        let exponent = in_8192ths(w).clamp(-(1 << 20), (1 << 20) - 1);
        match (logarithm(y) * exponent) >> 26 {
            ..-0x8000_0000 => 0,
            0x8000_0000.. => FIELD,
            p => power(p),
        }
    }

    fn log2(x: u32) -> u32 {
        match field(x) {
            0 => FIELD | SIGN,
            _ if is_nan(x) || x & SIGN != 0 => NAN,
            255 => FIELD,
            e => {
                let mantissa = interpolated(&NV3X_LG2, x & MANTISSA, false);
                let value = mantissa + (i64::from(e) - 127) * (1 << 38);
                cut_complement(value, 38)
            }
        }
    }

    fn exp2(x: u32) -> u32 {
        let (e, negative) = (field(x), x & SIGN != 0);
        match e {
            255 if is_nan(x) => NAN,
            ..70 => ONE,
            134.. => {
                if negative {
                    0
                } else {
                    FIELD
                }
            }
            _ => {
                let f = i64::from(significand(x));
                // Magnitudes below 2^-24 give 0.
                let whole = if e >= 127 { f << (e - 127) } else { f >> (127 - e) };
                let t = if negative { !whole } else { whole };
                let mantissa = interpolated(&NV3X_EX2, (t & i64::from(MANTISSA)) as u32, true) >> 15;
                normal(0, 127 + (t >> 23) as i32, mantissa)
            }
        }
    }
}

/// `v / 2^k`, to the nearest, halves up.
fn half_up(v: i64, k: i32) -> i64 {
    (v + (1 << (k - 1))) >> k
}

/// The interpolator of LG2 and EX2: `c0 + c1 r + c2 r r`, with the errors of the chip's multipliers.
fn interpolated(table: &[[i64; 3]], x: u32, is_exp2: bool) -> i64 {
    let (mut t, mut r) = ((x >> 16) as usize, i64::from(x & 0xffff));
    if t % 2 == 1 {
        (t, r) = (t + 1, r - 65536);
    }
    let [c0, c1, c2] = table[t / 2];
    let c = c2 * square(r);
    let quadratic = if is_exp2 { c >> 5 } else { (c + ((square(r) - 1024) >> 12) + 32) >> 5 };
    let linear = (c0 << 15) + (product(c1, r) << 6);
    if is_exp2 { linear + quadratic } else { linear - quadratic }
}

/// `r r / 2^14`, with the rounding of the chip's squarer.
fn square(r: i64) -> i64 {
    let q = r >> 7;
    let first = q * q + if r >> 6 & 1 == 1 { q } else { 0 };
    first + (0..6).filter(|i| r >> i & 1 == 1).map(|i| half_up(r, 13 - i)).sum::<i64>()
}

/// `c r / 2^13`, summed over the base-4 digits of `r`.
fn product(c: i64, r: i64) -> i64 {
    let (mut sum, mut rest, mut place) = (0, 2 * c, -14);
    while rest > 0 {
        let digit = [0i64, 1, 1, 2, -2, -1, -1, 0][(rest & 7) as usize];
        let shift = place + i32::from(digit.abs() == 2);
        let part = if shift >= 0 { r << shift } else { half_up(r, -shift) };
        sum += digit.signum() * part;
        (rest, place) = (rest >> 2, place + 2);
    }
    sum
}
