//! Tests sums of an aligning adder, and the multiply-add that truncates its product, against exact fractions.

use rayon::prelude::*;
use refsim::num::{Denormals, DotOrder, Format, Outcome, Overflow, Rounding, Tininess, ops};

use crate::environment::by_form;
use crate::random::Random;
use crate::rational::Q;
use crate::small_ops::{Reference, Val, decode};

/// Floats of at most 6 bits with all rules that affect sums.
fn formats() -> Vec<Format> {
    let mut all = Vec::new();
    for layout in ["e2m3", "e3m2", "e4m1", "e2m1", "e3m2fn", "e2m3fnuz"] {
        let layout: Format = layout.parse().expect("a format");
        for (_, rounding) in Rounding::ALL {
            for overflow in [Overflow::Infinity, Overflow::Saturate, Overflow::Nv30] {
                for denormals in [Denormals::Keep, Denormals::Flush] {
                    all.push(layout.with_rounding(rounding).with_overflow(overflow).with_denormals(denormals));
                }
            }
        }
    }
    all
}

/// The exponent of the leading bit of a positive fraction.
fn exponent(q: Q) -> i32 {
    (-60..60).rfind(|&e| Q::scaled(1, e).cmp(q).is_le()).expect("a leading bit")
}

/// Truncates to a multiple of `2^e`.
fn cut(q: Q, e: i32) -> Q {
    Q::scaled(q.mul(Q::scaled(1, -e)).floor(), e)
}

/// Values of bit patterns, with their signs; `None` if one is an infinity or NaN.
fn numbers(f: &Format, addends: &[u32]) -> Option<Vec<(bool, Q)>> {
    let number = |bits: &u32| match decode(f, *bits) {
        Val::Num(negative, q) => Some((negative, q)),
        _ => None,
    };
    addends.iter().map(number).collect()
}

/// Computes [`ops::sum_aligned`] of finite numbers by its definition.
fn by_definition(r: &Reference, bits: u8, numbers: &[(bool, Q)]) -> u32 {
    let nonzero: Vec<(bool, Q)> = numbers.iter().copied().filter(|(_, q)| q.n != 0).collect();
    let Some(top) = nonzero.iter().map(|&(_, q)| exponent(q)).max() else {
        let one_sign = numbers.iter().all(|(negative, _)| *negative == numbers[0].0);
        return r.finish(if one_sign { numbers[0].0 } else { r.cancelled() }, Q::new(0, 1)).bits;
    };
    let sum = nonzero.iter().fold(Q::new(0, 1), |sum, &(negative, q)| {
        let kept = cut(q, top - i32::from(bits));
        sum.add(if negative { kept.negated() } else { kept })
    });
    r.finish(if sum.n == 0 { r.cancelled() } else { sum.n < 0 }, sum.abs()).bits
}

/// Two to four patterns.
fn addends(random: &mut Random, f: &Format) -> Vec<u32> {
    (0..2 + random.below(3usize)).map(|_| random.bits() & f.mask()).collect()
}

#[test]
fn aligned_sums_are_cut_and_rounded_once() {
    let rounds = by_form(2_000, 100_000);
    formats().par_iter().for_each(|&f| {
        let (r, mut random) = (Reference { f, tininess: Tininess::After }, Random::new(17));
        for _ in 0..rounds {
            let addends = addends(&mut random, &f);
            let bits = random.below(9u8);
            let found = ops::sum_aligned(f, bits, &addends).bits;
            if let Some(numbers) = numbers(&f, &addends) {
                let expected = by_definition(&r, bits, &numbers);
                assert_eq!(found, expected, "{f} aligned:{bits} {addends:x?}: found {found:x}, expected {expected:x}");
            }
            // The order of addends does not matter.
            let mut turned = addends.clone();
            turned.rotate_left(1);
            turned.swap(0, 1);
            assert_eq!(ops::sum_aligned(f, bits, &turned).bits, found, "{f} aligned:{bits} {addends:x?}");
        }
    });
}

/// Every pair of numbers: with enough bits nothing is truncated, and the sum equals `add`; special values have separate
/// rules.
#[test]
fn enough_bits_make_the_exact_sum() {
    formats().par_iter().for_each(|&f| {
        for a in 0..=f.mask() {
            for b in 0..=f.mask() {
                let found = ops::sum_aligned(f, ops::MAX_ALIGNED_BITS, &[a, b]);
                let expected = ops::add(f, a, b);
                assert_eq!(found, expected, "{f} {a:x} {b:x}");
                if numbers(&f, &[a, b]).is_none() {
                    assert_eq!(ops::sum_aligned(f, 0, &[a, b]).bits, expected.bits, "{f} {a:x} {b:x}");
                }
            }
        }
    });
}

#[test]
fn aligned_dot_products_sum_rounded_products() {
    let rounds = by_form(1_000, 50_000);
    formats().par_iter().for_each(|&f| {
        let mut random = Random::new(19);
        for _ in 0..rounds {
            let terms: Vec<(u32, u32)> =
                addends(&mut random, &f).iter().map(|&a| (a, random.bits() & f.mask())).collect();
            for (_, rounding) in Rounding::ALL {
                let products = f.with_rounding(rounding);
                let rounded: Vec<(u32, u32)> =
                    terms.iter().map(|&(a, b)| (ops::mul(products, a, b).bits, f.one())).collect();
                let order = DotOrder::Aligned(ops::MAX_ALIGNED_BITS);
                let found = ops::dot_of_products(f, products, f, order, &terms).bits;
                assert_eq!(found, ops::dot(f, DotOrder::Exact, &rounded).bits, "{f} {products} {terms:x?}");
                if rounding == f.rounding {
                    assert_eq!(found, ops::dot(f, order, &terms).bits, "{f} {terms:x?}");
                }
            }
        }
    });
}

#[test]
fn cut_products_lose_bits_below_the_significand_and_nothing_else() {
    formats().par_iter().for_each(|&f| {
        let refsim::num::FormatKind::Float { man_bits, .. } = f.kind else { unreachable!("floats") };
        let r = Reference { f, tininess: Tininess::After };
        let step = by_form(7, 1);
        for a in 0..=f.mask() {
            for b in (0..=f.mask()).step_by(step) {
                for c in (0..=f.mask()).step_by(step) {
                    let found = ops::product_cut_mad(f, a, b, c);
                    let Some(values) = numbers(&f, &[a, b, c]) else {
                        assert_eq!(found, ops::fused_mad(f, a, b, c), "{f} {a:x} {b:x} {c:x}");
                        continue;
                    };
                    let ((sa, qa), (sb, qb), (sc, qc)) = (values[0], values[1], values[2]);
                    let product = qa.mul(qb);
                    let kept =
                        if product.n == 0 { product } else { cut(product, exponent(product) - i32::from(man_bits)) };
                    let signed = |negative: bool, q: Q| if negative { q.negated() } else { q };
                    let sum = signed(sa != sb, kept).add(signed(sc, qc));
                    let zeros = if (sa != sb) == sc && kept.n == 0 && qc.n == 0 { sc } else { r.cancelled() };
                    let expected = r.finish(if sum.n == 0 { zeros } else { sum.n < 0 }, sum.abs());
                    assert_eq!(found.bits, expected.bits, "{f} {a:x} {b:x} {c:x}");
                }
            }
        }
    });
}

/// Examples that can be checked by hand.
#[test]
fn examples_of_cut_bits() {
    let f = Format::FP24.with_rounding(Rounding::TowardZero);
    let n = |text: &str| refsim::num::decimal::from_decimal(f, text).expect("a number").bits;
    // One guard bit: bits below half a unit of the largest addend are lost before the sum.
    let sum = |bits: u8, addends: &[&str]| ops::sum_aligned(f, bits, &addends.iter().map(|t| n(t)).collect::<Vec<_>>());
    assert_eq!(sum(17, &["1", "-3.814697265625e-6"]).bits, n("1"), "2^-18 is gone");
    assert_ne!(sum(18, &["1", "-3.814697265625e-6"]).bits, n("1"));
    // The largest two cancel, the third lies 2^25 below them.
    assert_eq!(sum(17, &["33554432", "-33554432", "1"]), Outcome::new(0, refsim::num::Flags::INEXACT));
    assert_eq!(sum(25, &["33554432", "-33554432", "1"]).bits, n("1"));
    // A larger number of bits than the adder's means all of its bits.
    assert_eq!(sum(255, &["1", "2"]), sum(28, &["1", "2"]));
    // Fixed point has no exponents.
    let fixed = Format::S3_12;
    let terms = [(0x1000, 0x0001), (0x7fff, 0x7fff), (0x8001, 0x7fff)];
    assert_eq!(ops::dot(fixed, DotOrder::Aligned(3), &terms), ops::dot(fixed, DotOrder::Sequential, &terms));
    assert_eq!(ops::product_cut_mad(fixed, 0x1801, 0x1801, 1), ops::mad(fixed, 0x1801, 0x1801, 1));
}

#[test]
fn names_of_orders() {
    assert_eq!(DotOrder::named("aligned:0"), Some(DotOrder::Aligned(0)));
    assert_eq!(DotOrder::named("aligned:28"), Some(DotOrder::Aligned(28)));
    for other in ["aligned:29", "aligned:256", "aligned:-1", "aligned:", "aligned", "Exact", ""] {
        assert_eq!(DotOrder::named(other), None, "{other}");
    }
}
