//! s3.12 compared with plain integers.

use rayon::prelude::*;
use refsim::num::{Flags, Format, Overflow, Rounding, ops};

use crate::environment::by_form;

/// `p / 4096` rounded, in 64-bit integer arithmetic.
fn round(p: i64, rounding: Rounding) -> i64 {
    match rounding {
        Rounding::NearestEven => (p + 0x7ff + ((p >> 12) & 1)) >> 12,
        Rounding::NearestAway if p < 0 => -((-p + 0x800) >> 12),
        Rounding::NearestAway => (p + 0x800) >> 12,
        Rounding::TowardZero => p / 4096,
        Rounding::Down => p.div_euclid(4096),
        Rounding::Up => -(-p).div_euclid(4096),
        Rounding::Odd if p % 4096 != 0 => p.div_euclid(4096) | 1,
        Rounding::Odd => p / 4096,
        Rounding::Stochastic(_) => unreachable!("not among those tested here"),
    }
}

#[test]
fn s3_12_products_equal_integers() {
    let stride = by_form(509, 1);
    for (_, rounding) in Rounding::ALL {
        for overflow in [Overflow::Saturate, Overflow::Wrap] {
            let f = Format::S3_12.with_rounding(rounding).with_overflow(overflow);
            (0..=0xffffu32 / stride).into_par_iter().for_each(|i| {
                let a = i16::MIN.wrapping_add((i * stride) as i16);
                for b in i16::MIN..=i16::MAX {
                    let product = i64::from(a) * i64::from(b);
                    let whole = round(product, rounding);
                    let clamped = whole.clamp(-0x8000, 0x7fff);
                    let kept = if overflow == Overflow::Wrap { whole } else { clamped };
                    let mut flags = Flags::empty();
                    flags.set(Flags::INEXACT, whole * 4096 != product || whole != clamped);
                    flags.set(Flags::OVERFLOW, whole != clamped);
                    let found = ops::mul(f, a.cast_unsigned().into(), b.cast_unsigned().into());
                    assert!(
                        found.bits == (kept as u32 & 0xffff) && found.flags == flags,
                        "{f} {a} * {b}: found {found:?}, expected {kept} {flags:?}"
                    );
                }
            });
        }
    }
}

/// Widths up to 32 bits, with the longest intermediate results.
#[test]
fn wide_fixed_point_equals_integers() {
    let mut cases = crate::random::Random::new(7);
    for (int_bits, frac_bits) in [(0, 31), (31, 0), (15, 16), (1, 30), (8, 23), (3, 12), (1, 10)] {
        let f = Format::fixed(int_bits, frac_bits).expect("a format").with_rounding(Rounding::Down);
        let signed = |bits: u32| i128::from((bits << (32 - f.width())).cast_signed() >> (32 - f.width()));
        let fit = |exact: i128| {
            let end = 1i128 << (f.width() - 1);
            exact.clamp(-end, end - 1) as u32 & f.mask()
        };
        for _ in 0..20_000 {
            let [a, b, c] = std::array::from_fn(|_| {
                let r = cases.next();
                (r as u32).cast_signed() >> (r >> 59)
            });
            let [a, b, c] = [a, b, c].map(|x| x.cast_unsigned() & f.mask());
            let (x, y, z) = (signed(a), signed(b), signed(c));
            assert_eq!(ops::add(f, a, b).bits, fit(x + y), "{f} {a:#x} + {b:#x}");
            assert_eq!(ops::sub(f, a, b).bits, fit(x - y), "{f} {a:#x} - {b:#x}");
            assert_eq!(ops::mul(f, a, b).bits, fit((x * y) >> frac_bits), "{f} {a:#x} * {b:#x}");
            let fused = ((x * y) + (z << frac_bits)) >> frac_bits;
            assert_eq!(ops::fused_mad(f, a, b, c).bits, fit(fused), "{f} {a:#x} * {b:#x} + {c:#x}");
            if y != 0 {
                let (n, d) = if y < 0 { (-x, -y) } else { (x, y) };
                assert_eq!(ops::div(f, a, b).bits, fit((n << frac_bits).div_euclid(d)), "{f} {a:#x} / {b:#x}");
            }
            if x >= 0 {
                let root = (x << frac_bits).isqrt();
                assert_eq!(ops::sqrt(f, a).bits, fit(root), "{f} sqrt {a:#x}");
            }
        }
    }
}
