//! Tests normalized integers against their definition: the code is the exact fraction times `2^F - 1`, rounded to an
//! integer.

use rayon::prelude::*;
use refsim::num::{DotOrder, Flags, Format, Outcome, Overflow, Rounding, Unpacked, ops, unpack};

use crate::environment::by_form;
use crate::random::Random;

/// A format with its unit, computed independently of `Format`.
struct Reference {
    f: Format,
    bits: u32,
    unit: i128,
}

impl Reference {
    fn new(int_bits: u8, frac_bits: u8, rounding: Rounding, overflow: Overflow) -> Self {
        let f = Format::normalized(int_bits, frac_bits).expect("a format");
        let f = f.with_rounding(rounding).with_overflow(overflow);
        Self { f, bits: 1 + u32::from(int_bits) + u32::from(frac_bits), unit: (1 << frac_bits) - 1 }
    }

    fn code(&self, bits: u32) -> i128 {
        let half = 1i128 << (self.bits - 1);
        (i128::from(bits) + half).rem_euclid(2 * half) - half
    }

    /// `n / d` codes, rounded; `d` is positive.
    fn round(&self, n: i128, d: i128) -> Outcome {
        let (floor, rest) = (n.div_euclid(d), n.rem_euclid(d));
        let up = match self.f.rounding {
            Rounding::NearestEven => 2 * rest > d || (2 * rest == d && floor % 2 != 0),
            Rounding::NearestAway => 2 * rest > d || (2 * rest == d && n > 0),
            Rounding::TowardZero => rest != 0 && n < 0,
            Rounding::Down => false,
            Rounding::Up => rest != 0,
            Rounding::Odd => rest != 0 && floor % 2 == 0,
            Rounding::Stochastic(_) => unreachable!("not among those tested here"),
        };
        let (whole, half) = (floor + i128::from(up), 1i128 << (self.bits - 1));
        let mut flags = if rest == 0 { Flags::empty() } else { Flags::INEXACT };
        let fitted = whole.clamp(-half, half - 1);
        if fitted != whole {
            flags = Flags::OVERFLOW | Flags::INEXACT;
        }
        let code = if self.f.overflow == Overflow::Wrap { whole } else { fitted };
        Outcome::new(code.rem_euclid(2 * half) as u32, flags)
    }

    /// Checks all operations on the pair `a` and `b`, and the three-operand operations with `c`.
    fn check(&self, a: u32, b: u32, c: u32) {
        let (f, d) = (self.f, self.unit);
        let [x, y, z] = [a, b, c].map(|bits| self.code(bits));
        let same = |name: &str, found: Outcome, expected: Outcome| {
            assert!(found == expected, "{f} {name} {x} {y} {z}: found {found:x?}, expected {expected:x?}");
        };
        same("add", ops::add(f, a, b), self.round(x + y, 1));
        same("sub", ops::sub(f, a, b), self.round(x - y, 1));
        let product = self.round(x * y, d);
        same("mul", ops::mul(f, a, b), product);
        let sum = self.round(self.code(product.bits) + z, 1);
        same("mad", ops::mad(f, a, b, c), sum.also(product.flags));
        same("fused_mad", ops::fused_mad(f, a, b, c), self.round(x * y + z * d, d));
        let dot = ops::dot(f, DotOrder::Exact, &[(a, b), (b, c), (c, a)]);
        same("dot", dot, self.round(x * y + y * z + z * x, d));
        if y != 0 {
            same("div", ops::div(f, a, b), self.round(x * d * y.signum(), y.abs()));
        }
    }
}

/// All pairs of operands in the format of a combiner's registers and in its 9-bit format, each pair with a third
/// operand; by default only some of the first operands.
#[test]
fn every_pair() {
    for (int_bits, frac_bits, step) in [(0, 8, 1), (3, 8, 67), (7, 8, 16_411), (1, 5, 1)] {
        for (_, rounding) in Rounding::ALL {
            for overflow in [Overflow::Saturate, Overflow::Wrap] {
                let r = Reference::new(int_bits, frac_bits, rounding, overflow);
                let step = by_form(step, 1);
                (0..=r.f.mask()).step_by(step).collect::<Vec<_>>().into_par_iter().for_each(|a| {
                    let mut cases = Random::new(a.into());
                    (0..=r.f.mask()).for_each(|b| r.check(a, b, cases.next() as u32 & r.f.mask()));
                });
            }
        }
    }
}

#[test]
fn every_code() {
    for (int_bits, frac_bits) in [(0, 8), (3, 8), (7, 8), (13, 2), (2, 6)] {
        for (_, rounding) in Rounding::ALL {
            for overflow in [Overflow::Saturate, Overflow::Wrap] {
                let r = Reference::new(int_bits, frac_bits, rounding, overflow);
                let (f, d) = (r.f, r.unit);
                for a in 0..=f.mask() {
                    let x = r.code(a);
                    let same = |name: &str, found: Outcome, expected: Outcome| {
                        assert!(found == expected, "{f} {name} {x}: found {found:x?}, expected {expected:x?}");
                    };
                    for k in 0..=4 {
                        same("scale up", ops::scale(f, a, k), r.round(x << k, 1));
                        same("scale down", ops::scale(f, a, -k), r.round(x, 1 << k));
                    }
                    same("floor", ops::floor(f, a), r.round(x.div_euclid(d) * d, 1));
                    same("frc", ops::frc(f, a), r.round(x.rem_euclid(d), 1));
                    same("neg", ops::neg(f, a), r.round(-x, 1));
                    same("abs", ops::abs(f, a), r.round(x.abs(), 1));
                    assert_eq!(ops::saturate01(f, a).bits, r.round(x.clamp(0, d), 1).bits, "{f} {x}");
                    assert_eq!(ops::cnd(f, a, 1, 0).bits == 1, 2 * x > d, "{f} {x} beyond one half");
                    if x != 0 {
                        same("rcp", ops::rcp(f, a), r.round(d * d * x.signum(), x.abs()));
                    }
                }
            }
        }
    }
}

/// Conversions to and from fixed point, floats and other units.
#[test]
fn conversions() {
    let dyadic = ["s3.8", "s0.15", "s15.16", "s1.2:rtz", "e5m10", "e7m16:rdn", "e8m23:rtz", "e8m23:rna", "e2m1"];
    for (_, rounding) in Rounding::ALL {
        let r = Reference::new(3, 8, rounding, Overflow::Saturate);
        for (int_bits, frac_bits) in [(3, 8), (0, 8), (7, 8), (0, 4), (2, 3), (1, 7)] {
            let from = Reference::new(int_bits, frac_bits, Rounding::Down, Overflow::Wrap);
            for a in 0..=from.f.mask() {
                let expected = r.round(from.code(a) * r.unit, from.unit);
                assert_eq!(ops::convert(&from.f, r.f, a), expected, "{} {a:#x} to {}", from.f, r.f);
            }
        }
        for text in dyadic {
            let other: Format = text.parse().expect("a format");
            let mut cases = Random::new(7);
            for _ in 0..20_000 {
                let a = (cases.next() as u32 >> (cases.next() % 24)) & other.mask();
                let Unpacked::Finite { sign, sig, exp, .. } = unpack(&other, a) else { continue };
                let n = i128::from(sig) * if sign { -1 } else { 1 };
                if exp > -100 && exp < 60 {
                    let (n, d) = if exp >= 0 { (n << exp, 1) } else { (n, 1 << -exp) };
                    assert_eq!(ops::convert(&other, r.f, a), r.round(n * r.unit, d), "{text} {a:#x} to {}", r.f);
                }
            }
            // Wide formats hold the code and 255 exactly, and divide them.
            if other.width() >= 24 {
                let whole = |n: i128| ops::convert(&Format::FP32, other, (n as f32).to_bits()).bits;
                for a in 0..=r.f.mask() {
                    let expected = ops::div(other, whole(r.code(a)), whole(r.unit));
                    assert_eq!(ops::convert(&r.f, other, a), expected, "{} {a:#x} to {text}", r.f);
                }
            }
        }
    }
}
