//! Tests fp24 against double precision, fp32 against the host, fused fp32 against rustc_apfloat.

use rayon::prelude::*;
use refsim::num::{Format, Rounding, from_ratio, ops};
use rustc_apfloat::Float;
use rustc_apfloat::ieee::Single;

use crate::environment::by_form;
use crate::half::{MODES, agree};
use crate::random::Random;

/// Runs `body` on generators of 64 seeds, in parallel.
fn seeds(cases: u64, body: impl Fn(&mut Random) + Sync) {
    (0..64u64).into_par_iter().for_each(|seed| {
        let mut generator = Random::new(seed << 32);
        for _ in 0..cases / 64 {
            body(&mut generator);
        }
    });
}

/// Converts fp24 to double, by the definition of the format.
fn widen(bits: u32) -> f64 {
    let sign = if bits >> 23 == 1 { -1.0 } else { 1.0 };
    let (field, man) = ((bits >> 16) & 0x7f, f64::from(bits & 0xffff));
    match (field, man == 0.0) {
        (0x7f, true) => sign * f64::INFINITY,
        (0x7f, false) => f64::NAN,
        (0, _) => sign * man * power(-78),
        _ => sign * (man + 65536.0) * power(field.cast_signed() - 79),
    }
}

/// `2^k` for exponents of normal doubles.
fn power(k: i32) -> f64 {
    f64::from_bits(((1023 + i64::from(k)) as u64) << 52)
}

/// Converts a double to fp24 by counting units in the last place: products with powers of two and `floor` are exact.
fn narrow(x: f64, rounding: Rounding) -> Option<u32> {
    if x.is_nan() {
        return Format::FP24.canonical_nan();
    }
    let sign = if x.is_sign_negative() { 0x80_0000 } else { 0 };
    let magnitude = x.abs();
    if magnitude == f64::INFINITY {
        return Some(sign | 0x7f_0000);
    }
    // 2^top <= magnitude, but not below the smallest normal exponent.
    let top = (((magnitude.to_bits() >> 52) as u32).cast_signed() - 1023).clamp(-62, 200);
    let units = magnitude * power(16 - top);
    let mut whole = units.floor();
    let rest = units - whole;
    let odd = whole as u64 & 1 == 1;
    let up = match rounding {
        Rounding::NearestEven => rest > 0.5 || (rest == 0.5 && odd),
        Rounding::NearestAway => rest >= 0.5,
        Rounding::TowardZero => false,
        Rounding::Down => sign != 0 && rest > 0.0,
        Rounding::Up => sign == 0 && rest > 0.0,
        Rounding::Odd => rest > 0.0 && !odd,
        Rounding::Stochastic(_) => unreachable!("not among those tested here"),
    };
    whole += if up { 1.0 } else { 0.0 };
    let value = whole * power(top - 16);
    let largest = widen(0x7e_ffff);
    if value > largest {
        let infinite = match rounding {
            Rounding::NearestEven | Rounding::NearestAway => true,
            Rounding::TowardZero | Rounding::Odd | Rounding::Stochastic(_) => false,
            Rounding::Down => sign != 0,
            Rounding::Up => sign == 0,
        };
        return Some(sign | if infinite { 0x7f_0000 } else { 0x7e_ffff });
    }
    let subnormal = value < power(-62);
    let bits = if subnormal {
        (value * power(78)) as u32
    } else {
        let top = ((value.to_bits() >> 52) as u32).cast_signed() - 1023;
        ((top + 63) as u32) << 16 | ((value * power(16 - top)) as u32 & 0xffff)
    };
    Some(sign | bits)
}

/// `a + b` rounded to odd, so that a second rounding to 36 bits less is correct.
fn add_to_odd(a: f64, b: f64) -> f64 {
    let sum = a + b;
    if !sum.is_finite() {
        return sum;
    }
    // The exact error of a sum of two doubles (Knuth).
    let b_part = sum - a;
    let error = (a - (sum - b_part)) + (b - b_part);
    match (error == 0.0 || sum.to_bits() & 1 == 1, error > 0.0) {
        (true, _) => sum,
        (_, true) => sum.next_up(),
        (_, false) => sum.next_down(),
    }
}

/// Sums via rounding to odd. Products of 17-bit numbers are exact in a double. Quotients and roots of 17-bit numbers
/// are never closer than a relative 2^-36 to a number or midpoint of fp24 that they don't equal.
#[test]
fn fp24_equals_double() {
    let cases = by_form(1_000_000, 100_000_000);
    for (_, rounding) in Rounding::ALL {
        let f = Format::FP24.with_rounding(rounding);
        let zero = |bits: u32| bits & 0x7f_ffff == 0;
        seeds(cases, |generator| {
            let (a, b) = (generator.float_bits(7, 16), generator.float_bits(7, 16));
            let (x, y) = (widen(a), widen(b));
            let check = |name: &str, found: u32, exact: f64| {
                let expected = narrow(exact, rounding);
                assert!(Some(found) == expected, "{f} {name} {a:#x} {b:#x}: found {found:#x}, expected {expected:x?}");
            };
            // Unlike on the host, the sign of a sum that cancels depends on the rounding.
            let sum = ops::add(f, a, b).bits;
            if !(zero(sum) && rounding == Rounding::Down) {
                check("add", sum, add_to_odd(x, y));
            }
            check("mul", ops::mul(f, a, b).bits, x * y);
            check("div", ops::div(f, a, b).bits, x / y);
            check("sqrt", ops::sqrt(f, a).bits, x.sqrt());
            check("rcp", ops::rcp(f, a).bits, 1.0 / x);
        });
    }
}

#[test]
fn fp32_equals_host() {
    let cases = by_form(3_000_000, 1_000_000_000);
    let f = Format::FP32;
    seeds(cases, |generator| {
        let (a, b) = (generator.float_bits(8, 23), generator.float_bits(8, 23));
        let (x, y) = (f32::from_bits(a), f32::from_bits(b));
        let check = |name: &str, found: u32, host: f32| {
            // Tests the bits for NaN: optimised code was seen to compute the root of a negative number as another
            // value.
            let bits = host.to_bits();
            let expected = if bits & 0x7fff_ffff > 0x7f80_0000 { 0x7fc0_0000 } else { bits };
            assert!(found == expected, "{name} {a:#x} {b:#x}: found {found:#x}, expected {expected:#x}");
        };
        check("add", ops::add(f, a, b).bits, x + y);
        check("sub", ops::sub(f, a, b).bits, x - y);
        check("mul", ops::mul(f, a, b).bits, x * y);
        check("div", ops::div(f, a, b).bits, x / y);
        check("rcp", ops::rcp(f, a).bits, 1.0 / x);
        check("sqrt", ops::sqrt(f, a).bits, x.sqrt());
        check("floor", ops::floor(f, a).bits, x.floor());
        check("round", ops::round_to_int(f, a).bits, x.round_ties_even());
        let (n, d) = (a & 0xff_ffff, (b & 0xff_ffff).max(1));
        check("ratio", from_ratio(f, false, n.into(), d.into()).bits, n as f32 / d as f32);
        assert_eq!(ops::lt(f, a, b).bits == 1, x < y, "{a:#x} < {b:#x}");
        assert_eq!(ops::le(f, a, b).bits == 1, x <= y, "{a:#x} <= {b:#x}");
        assert_eq!(ops::eq(f, a, b).bits == 1, x == y, "{a:#x} == {b:#x}");
    });
}

#[test]
fn fp32_equals_apfloat() {
    let cases = by_form(400_000, 100_000_000);
    for (rounding, round) in MODES {
        let f = Format::FP32.with_rounding(rounding);
        seeds(cases, |generator| {
            let [a, b, c] = std::array::from_fn(|_| generator.float_bits(8, 23));
            let [x, y, z] = [a, b, c].map(|bits| Single::from_bits(bits.into()));
            for (name, found, expected) in [
                ("fused", ops::fused_mad(f, a, b, c), x.mul_add_r(y, z, round)),
                ("add", ops::add(f, a, b), x.add_r(y, round)),
                ("mul", ops::mul(f, a, b), x.mul_r(y, round)),
                ("div", ops::div(f, a, b), x.div_r(y, round)),
                ("round", ops::round_to_int_exact(f, a), x.round_to_integral(round)),
            ] {
                let result = agree(&f, found, expected);
                assert!(result.is_ok(), "{name} {a:#x} {b:#x} {c:#x}: {}", result.unwrap_err());
            }
        });
    }
}
