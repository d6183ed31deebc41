//! `exp2` and `log2` compared with independent computations: products of repeated square roots of two, and the series
//! of the inverse hyperbolic tangent, both with 320 fraction bits.

use num_bigint::BigInt;
use num_traits::One;
use rayon::prelude::*;
use refsim::num::{Flags, Format, Rounding, Unpacked, ops, unpack};

use crate::environment::by_form;
use crate::random::Random;

const PLACES: u32 = 320;

/// A finite pattern in units of `2^-PLACES`.
fn value(f: &Format, bits: u32) -> BigInt {
    let Unpacked::Finite { sign, sig, exp, .. } = unpack(f, bits) else { panic!("{bits:#x} is not finite") };
    let magnitude = BigInt::from(sig) << (exp + PLACES.cast_signed());
    if sign { -magnitude } else { magnitude }
}

/// `2^(2^-i)` for i from 1, by repeated square roots.
fn roots() -> Vec<BigInt> {
    let mut root = BigInt::from(2) << PLACES;
    (0..160)
        .map(|_| {
            root = (&root << PLACES).sqrt();
            root.clone()
        })
        .collect()
}

/// `2^x` for `x` in units of `2^-PLACES`, with a relative error of about `2^-300`.
fn exp2(x: &BigInt, roots: &[BigInt]) -> (BigInt, i64) {
    let whole = i64::try_from(x >> PLACES).expect("a small exponent");
    let mut product = BigInt::one() << PLACES;
    for (i, root) in (1u64..).zip(roots) {
        if x.bit(u64::from(PLACES) - i) {
            product = (product * root) >> PLACES;
        }
    }
    (product, whole)
}

/// `ln x = 2 atanh((x - 1) / (x + 1))` for x near [1, 2].
fn ln(x: &BigInt) -> BigInt {
    let one = BigInt::one() << PLACES;
    let z = ((x - &one) << PLACES) / (x + &one);
    let square = (&z * &z) >> PLACES;
    let (mut sum, mut term) = (BigInt::ZERO, z);
    for k in (1u32..).step_by(2) {
        if term.bits() < 2 {
            break;
        }
        sum += &term / k;
        term = (term * &square) >> PLACES;
    }
    sum << 1
}

/// Asserts that `bits` is `exact` (in units of `2^-PLACES`, never a number or midpoint of the format), rounded.
fn check(f: &Format, name: &str, x: u32, bits: u32, exact: &BigInt) {
    let negative = *exact < BigInt::ZERO;
    let magnitude = if negative { -exact } else { exact.clone() };
    let low_bits = bits & !f.sign_bit();
    assert_eq!(f.is_negative(bits), negative, "{f} {name} {x:#x}: sign of {bits:#x}");
    let down = |b: u32| if b == 0 { BigInt::ZERO } else { value(f, b - 1) };
    let up = |b: u32| if b == f.max_finite() { value(f, b) * 2 - value(f, b - 1) } else { value(f, b + 1) };
    let here = value(f, low_bits);
    let truncated = match f.rounding {
        Rounding::TowardZero => Some(true),
        Rounding::Down => Some(!negative),
        Rounding::Up => Some(negative),
        // The odd pattern may lie on either side of the number.
        Rounding::Odd => {
            let near = down(low_bits) < magnitude && magnitude < up(low_bits);
            assert!(bits & 1 == 1 && near, "{f} {name} {x:#x}: {bits:#x} is not the odd neighbour");
            return;
        }
        _ => None,
    };
    let (low, high) = match truncated {
        Some(true) => (here.clone(), up(low_bits)),
        Some(false) => (down(low_bits), here.clone()),
        None => ((down(low_bits) + &here) >> 1, (up(low_bits) + &here) >> 1),
    };
    assert!(low <= magnitude && magnitude < high, "{f} {name} {x:#x}: {bits:#x} is not the rounded value");
}

/// Operands of a format: all patterns of a short format, otherwise a sample.
fn operands(f: &Format, exp_bits: u32, man_bits: u32) -> Vec<u32> {
    if f.width() <= 16 {
        let step = by_form(7, 1);
        return (0..=f.mask()).step_by(step).collect();
    }
    let count = by_form(6_000, 400_000);
    let mut cases = Random::new(99);
    (0..count).map(|_| cases.float_bits(exp_bits, man_bits)).collect()
}

fn formats() -> impl Iterator<Item = (Format, u32, u32)> {
    let roundings = Rounding::ALL.map(|(_, rounding)| rounding);
    [(Format::FP16, 5, 10), (Format::FP24, 7, 16), (Format::FP32, 8, 23)]
        .into_iter()
        .flat_map(move |(f, e, m)| roundings.map(|r| (f.with_rounding(r), e, m)))
}

#[test]
fn exp2_is_correctly_rounded() {
    let roots = roots();
    for (f, exp_bits, man_bits) in formats() {
        let emax = (1 << (exp_bits - 1)) - 1;
        operands(&f, exp_bits, man_bits).par_iter().for_each(|&x| {
            if !f.is_finite(x) {
                return;
            }
            let exact = value(&f, x);
            let whole = (&exact >> PLACES).clamp(BigInt::from(-1000), BigInt::from(1000));
            let whole = i32::try_from(whole).expect("a small number");
            let found = ops::exp2(f, x);
            let integer = &exact % (BigInt::one() << PLACES) == BigInt::ZERO;
            if whole > emax {
                assert!(found.flags.contains(Flags::OVERFLOW), "{f} exp2 {x:#x}: {found:?}");
            } else if whole < -emax - man_bits.cast_signed() - 3 {
                let least = u32::from(matches!(f.rounding, Rounding::Up | Rounding::Odd));
                assert!(found.bits == least && found.flags.contains(Flags::UNDERFLOW), "{f} exp2 {x:#x}: {found:?}");
            } else if integer && whole >= 1 - emax - man_bits.cast_signed() {
                assert_eq!(value(&f, found.bits), BigInt::one() << (whole + PLACES.cast_signed()));
                assert_eq!(found.flags, Flags::empty(), "{f} exp2 {x:#x}");
            } else if integer {
                // Below the smallest subnormal: at most a midpoint.
                let up = match f.rounding {
                    Rounding::NearestAway => whole == -emax - man_bits.cast_signed(),
                    rounding => matches!(rounding, Rounding::Up | Rounding::Odd),
                };
                assert_eq!(found.bits, u32::from(up), "{f} exp2 {x:#x}");
            } else if f.is_finite(found.bits) {
                let (product, whole) = exp2(&exact, &roots);
                let product = if whole >= 0 { product << whole } else { product >> -whole };
                check(&f, "exp2", x, found.bits, &product);
                assert!(found.flags.contains(Flags::INEXACT), "{f} exp2 {x:#x}");
            } else {
                assert!(whole == emax && found.flags.contains(Flags::OVERFLOW), "{f} exp2 {x:#x}: {found:?}");
            }
        });
    }
}

#[test]
fn log2_is_correctly_rounded() {
    let ln2 = ln(&(BigInt::from(2) << PLACES));
    for (f, exp_bits, man_bits) in formats() {
        operands(&f, exp_bits, man_bits).par_iter().for_each(|&x| {
            let Unpacked::Finite { sign, sig, exp, .. } = unpack(&f, x) else { return };
            if sig == 0 {
                return;
            }
            let found = ops::log2(f, x);
            if sign {
                assert!(f.is_nan(found.bits) && found.flags == Flags::INVALID, "{f} log2 {x:#x}: {found:?}");
                return;
            }
            let top = 63 - sig.leading_zeros().cast_signed();
            if sig.is_power_of_two() {
                assert_eq!(value(&f, found.bits), BigInt::from(exp + top) << PLACES, "{f} log2 {x:#x}");
                assert_eq!(found.flags, Flags::empty(), "{f} log2 {x:#x}");
                return;
            }
            let mantissa = BigInt::from(sig) << (PLACES.cast_signed() - top);
            let exact = ((ln(&mantissa) << PLACES) / &ln2) + (BigInt::from(exp + top) << PLACES);
            check(&f, "log2", x, found.bits, &exact);
            assert!(found.flags.contains(Flags::INEXACT), "{f} log2 {x:#x}");
        });
    }
}

/// Cases that an enclosure in machine words cannot decide: results very close to a number of the format.
#[test]
fn hard_cases() {
    let down = Format::FP32.with_rounding(Rounding::Down);
    let up_to_one = ops::exp2(down, 0x8000_0001);
    assert_eq!((up_to_one.bits, up_to_one.flags), (0x3f7f_ffff, Flags::INEXACT));
    assert_eq!(ops::exp2(down, 1).bits, 0x3f80_0000);
    assert_eq!(ops::exp2(Format::FP32, 0x8000_0001).bits, 0x3f80_0000);
}
