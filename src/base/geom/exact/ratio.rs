//! Fractions of big integers, compared exactly and rounded once.

use std::cmp::Ordering;

use num_bigint::BigUint;
use num_integer::Integer;
use num_traits::Zero;

/// Rounds `num / den` to the nearest f32, ties to even; infinity from 2^128 - 2^103 up. `den` must not be zero.
pub fn to_f32(num: &BigUint, den: &BigUint) -> f32 {
    match round(num, den, 24, -149, 128) {
        None => f32::INFINITY,
        Some((mantissa, _)) if mantissa < 1 << 23 => f32::from_bits(mantissa as u32),
        Some((mantissa, unit)) => {
            // A normal number: its leading bit is implied, and the unit -149 belongs to the exponent field 1.
            f32::from_bits(((unit + 150) as u32) << 23 | (mantissa as u32 & 0x7f_ffff))
        }
    }
}

/// Rounds `num / den` to the nearest f64, ties to even; infinity beyond the format. `den` must not be zero.
pub fn to_f64(num: &BigUint, den: &BigUint) -> f64 {
    match round(num, den, 53, -1074, 1024) {
        None => f64::INFINITY,
        Some((mantissa, _)) if mantissa < 1 << 52 => f64::from_bits(mantissa),
        Some((mantissa, unit)) => f64::from_bits(((unit + 1075) as u64) << 52 | (mantissa & 0xf_ffff_ffff_ffff)),
    }
}

/// Compares `a_num / a_den` with `b_num / b_den` by cross multiplication; both denominators positive.
pub fn compare(a_num: &BigUint, a_den: &BigUint, b_num: &BigUint, b_den: &BigUint) -> Ordering {
    (a_num * b_den).cmp(&(b_num * a_den))
}

/// Rounds `num / den` to mantissa * 2^unit with at most `bits` bits, `unit >= lowest`, to nearest even; `None` when the
/// rounded value reaches 2^`top`. The mantissa has exactly `bits` bits unless `unit == lowest`.
fn round(num: &BigUint, den: &BigUint, bits: u32, lowest: i64, top: i64) -> Option<(u64, i64)> {
    if num.is_zero() {
        return Some((0, lowest));
    }
    // num / den lies in (2^(length - 1), 2^(length + 1)).
    let length = num.bits().cast_signed() - den.bits().cast_signed();
    let limit = 1_u64 << bits;
    let mut unit = (length - i64::from(bits)).max(lowest);
    loop {
        let (shifted_num, shifted_den) = scaled(num, den, unit);
        let (quotient, rest) = shifted_num.div_rem(&shifted_den);
        let Some(mut mantissa) = small(&quotient).filter(|&mantissa| mantissa < limit) else {
            unit += 1;
            continue;
        };
        match (rest << 1_u8).cmp(&shifted_den) {
            Ordering::Greater => mantissa += 1,
            Ordering::Equal => mantissa += mantissa & 1,
            Ordering::Less => {}
        }
        if mantissa == limit {
            mantissa >>= 1;
            unit += 1;
        }
        return (unit + i64::from(bits) <= top).then_some((mantissa, unit));
    }
}

fn scaled(num: &BigUint, den: &BigUint, unit: i64) -> (BigUint, BigUint) {
    if unit < 0 { (num << unit.unsigned_abs(), den.clone()) } else { (num.clone(), den << unit.unsigned_abs()) }
}

fn small(value: &BigUint) -> Option<u64> {
    u64::try_from(value).ok()
}
