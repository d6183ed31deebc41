//! `2^x` and `log2 x`, rounded to odd into a double: the batch executor's implementation, in 128-bit fixed point.
//!
//! Both are irrational unless obviously exact (an integer exponent, a power of two), so the true value is never on a
//! rounding boundary. The evaluations below are accurate to 2^-95. Operands have at most 32 bits, so the probability
//! that any result is nearer than 2^-75 to a boundary is about one in a million. With `CROSSBAR_FULL=1`, tests compare
//! every operand of every 16-bit format.

use super::layout::pow2;

/// ln 2 in units of 2^-128.
const LN2: u128 = 0xb172_17f7_d1cf_79ab_c9e3_b398_03f2_f6af;

/// Fraction bits of logarithms and of split exponents.
const FRACTION: u32 = 100;

/// The upper half of a 256-bit product.
fn mul_high(a: u128, b: u128) -> u128 {
    let low = u128::from(u64::MAX);
    let (a1, a0, b1, b0) = (a >> 64, a & low, b >> 64, b & low);
    let middle = ((a0 * b0) >> 64) + ((a1 * b0) & low) + ((a0 * b1) & low);
    a1 * b1 + ((a1 * b0) >> 64) + ((a0 * b1) >> 64) + (middle >> 64)
}

/// `2^x` rounded to odd; `x` has at most 32 significant bits. Infinities and NaN as in IEEE 754. For `|x|` above 900
/// the result is some double that overflows or underflows in every format, as the exact value does.
pub(crate) fn exp2(x: f64) -> f64 {
    const ONE: u64 = 1023 << 52;
    if x.is_nan() || x == f64::INFINITY {
        return x;
    }
    if x == f64::NEG_INFINITY {
        return 0.0;
    }
    if x >= 900.0 {
        return f64::from_bits((1023 + 900) << 52 | 1);
    }
    if x <= -900.0 {
        return f64::from_bits((1023 - 900) << 52 | 1);
    }
    if x == x.floor() {
        return pow2(x as i32);
    }
    if x.abs() < TINY {
        // 1 + x ln 2 + ...: no rounding boundary of a format is so near to 1.
        return f64::from_bits(if x > 0.0 { ONE | 1 } else { ONE - 1 });
    }
    let bits = x.to_bits();
    let significand = i128::from(bits & ((1 << 52) - 1) | 1 << 52);
    // |x| >= 2^-40 and 53 bits: at least 8 fraction bits remain below the significand.
    let exponent = (bits >> 52 & 0x7ff) as u32 + FRACTION - 1023 - 52;
    let fixed = if x < 0.0 { -(significand << exponent) } else { significand << exponent };
    let whole = (fixed >> FRACTION) as i64;
    let fraction = (fixed as u128 & ((1 << FRACTION) - 1)) << (128 - FRACTION);
    // 2^f = e^t = sum t^k / k!, in units of 2^-126.
    let t = mul_high(fraction, LN2);
    let (mut sum, mut term) = (1u128 << 126, t >> 2);
    let mut k = 1u128;
    while term != 0 {
        sum += term;
        k += 1;
        term = mul_high(term, t) / k;
    }
    let mantissa = (sum >> 74) as u64 & ((1 << 52) - 1);
    f64::from_bits(((whole + 1023) as u64) << 52 | mantissa | 1)
}

const TINY: f64 = 1.0 / 1_099_511_627_776.0;

/// `log2 x` rounded to odd, for `x > 0` of at most 32 significant bits; NaN and infinity are returned unchanged.
pub(crate) fn log2(x: f64) -> f64 {
    if x.is_nan() || x == f64::INFINITY {
        return x;
    }
    let bits = x.to_bits();
    let exponent = i128::from(bits >> 52) - 1023;
    let mantissa = bits & ((1 << 52) - 1);
    if mantissa == 0 {
        return exponent as f64;
    }
    // Squaring the significand doubles its logarithm: each carry past 2 is the next bit.
    let mut m = u128::from(mantissa | 1 << 52) << 75;
    let mut fraction = 0i128;
    for _ in 0..FRACTION {
        let square = mul_high(m, m);
        let carry = square >> 127;
        fraction = fraction << 1 | carry.cast_signed();
        m = if carry == 1 { square } else { square << 1 };
    }
    let value = (exponent << FRACTION) + fraction;
    // The exact value lies just above `value`; truncating a negative magnitude subtracts one.
    let magnitude = if value < 0 { (-value - 1) as u128 } else { value as u128 };
    let top = 127 - magnitude.leading_zeros();
    let kept = (magnitude >> (top - 52)) as u64 & ((1 << 52) - 1);
    let power = u64::from(top + 1023 - FRACTION) << 52;
    let sign = if value < 0 { super::odd::SIGN } else { 0 };
    f64::from_bits(sign | power | kept | 1)
}
