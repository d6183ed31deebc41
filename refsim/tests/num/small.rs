//! Tests every operation of every format with at most 6 bits: all operands, every combination of rules.

use std::cmp::Ordering;

use num_bigint::BigUint;
use rayon::prelude::*;
use refsim::num::{
    Denormals, DotOrder, Encoding, Format, Outcome, Overflow, Rounding, Specials, Tininess, from_parts, from_ratio, ops,
};

use crate::environment::by_form;
use crate::random::Random;
use crate::rational::{self, Q};
use crate::small_ops::Reference;

/// Every layout with at most 6 bits and every meaningful combination of rules.
fn formats() -> Vec<Format> {
    let mut all = Vec::new();
    let fixed = (0..6).flat_map(|i| (0..6).filter_map(move |f| Format::fixed(i, f)));
    let normalized = (0..4).flat_map(|i| (2..6).filter_map(move |f| Format::normalized(i, f)));
    for layout in fixed.chain(normalized).filter(|f| f.width() <= 6) {
        for (_, rounding) in Rounding::ALL {
            for overflow in [Overflow::Saturate, Overflow::Wrap] {
                all.push(layout.with_rounding(rounding).with_overflow(overflow));
            }
        }
    }
    let floats = (2..6).flat_map(|x| (1..6).filter_map(move |m| Format::float(x, m))).filter(|f| f.width() <= 6);
    let encodings = [Encoding::Ieee, Encoding::Finite, Encoding::UnsignedZero];
    let encoded = floats.flat_map(|f| encodings.map(|encoding| f.with_encoding(encoding)));
    // Finite floats have NaN only from 7 bits on.
    let seven = [(2, 4), (4, 2), (3, 3)].into_iter().filter_map(|(x, m)| Format::float(x, m));
    for layout in encoded.chain(seven.map(|f| f.with_encoding(Encoding::Finite))) {
        for (_, rounding) in Rounding::ALL {
            for overflow in [Overflow::Infinity, Overflow::Saturate, Overflow::Nv30] {
                for denormals in [Denormals::Keep, Denormals::Flush] {
                    for specials in [Specials::Ieee, Specials::Nv] {
                        let format = layout.with_rounding(rounding).with_overflow(overflow);
                        all.push(format.with_denormals(denormals).with_specials(specials));
                    }
                }
            }
        }
    }
    assert_eq!(all.len(), (20 + 10) * 12 + (3 * 6 + 3) * 72);
    all
}

/// References for a format; for floats, one per tininess rule.
fn references(f: Format) -> Vec<Reference> {
    let both = [Tininess::After, Tininess::Before];
    both[..if f.is_fixed() { 1 } else { 2 }].iter().map(|&tininess| Reference { f, tininess }).collect()
}

fn for_all(body: impl Fn(&Reference) + Sync) {
    formats().par_iter().for_each(|&f| references(f).iter().for_each(&body));
}

#[track_caller]
fn same(r: &Reference, name: &str, operands: &[u32], found: Outcome, expected: Outcome) {
    assert!(
        found == expected,
        "{} ({:?}) {name} {operands:x?}: found {found:x?}, expected {expected:x?}",
        r.f,
        r.tininess
    );
}

#[test]
fn unary_operations() {
    for_all(|r| {
        let f = r.f.tininess(r.tininess);
        for a in 0..=r.f.mask() {
            let x = r.val(a);
            let same = |name, found, expected| same(r, name, &[a], found, expected);
            same("sqrt", ops::sqrt(f, a), r.sqrt(x));
            same("rcp", ops::rcp(f, a), r.rcp(x));
            same("rsq", ops::rsq(f, a), r.rsq(x));
            same("exp2", ops::exp2(f, a), r.exp2(x));
            same("log2", ops::log2(f, a), r.log2(x));
            same("floor", ops::floor(f, a), r.to_int(x, Rounding::Down, false));
            same("frc", ops::frc(f, a), r.frc(x));
            same("round_to_int", ops::round_to_int(f, a), r.to_int(x, r.f.rounding, false));
            same("round_to_int_exact", ops::round_to_int_exact(f, a), r.to_int(x, r.f.rounding, true));
            same("neg", ops::neg(f, a), r.neg(a));
            same("abs", ops::abs(f, a), r.abs(a));
            same("saturate01", ops::saturate01(f, a), r.saturate01(a));
            for k in -9..=9 {
                same("scale", ops::scale(f, a, k), r.scale(x, k));
            }
        }
    });
}

#[test]
fn binary_operations() {
    for_all(|r| {
        let f = r.f.tininess(r.tininess);
        for a in 0..=r.f.mask() {
            for b in 0..=r.f.mask() {
                let (x, y) = (r.val(a), r.val(b));
                let same = |name, found, expected| same(r, name, &[a, b], found, expected);
                same("add", ops::add(f, a, b), r.add(x, y));
                same("sub", ops::sub(f, a, b), r.add(x, Reference::negated(y)));
                same("mul", ops::mul(f, a, b), r.mul(x, y));
                same("div", ops::div(f, a, b), r.div(x, y));
                same("min", ops::min(f, a, b), r.min_max(a, b, Ordering::is_lt));
                same("max", ops::max(f, a, b), r.min_max(a, b, Ordering::is_ge));
                same("eq", ops::eq(f, a, b), r.compare(x, y, true, Ordering::is_eq));
                same("lt", ops::lt(f, a, b), r.compare(x, y, false, Ordering::is_lt));
                same("le", ops::le(f, a, b), r.compare(x, y, false, Ordering::is_le));
                same("lt_quiet", ops::lt_quiet(f, a, b), r.compare(x, y, true, Ordering::is_lt));
                same("le_quiet", ops::le_quiet(f, a, b), r.compare(x, y, true, Ordering::is_le));
                same("cmp", ops::cmp(f, a, b, a), r.select(x, Q::new(0, 1), false, b, a));
                same("cnd", ops::cnd(f, a, b, a), r.select(x, Q::new(1, 2), true, b, a));
            }
        }
    });
}

/// `pow` consists of three operations; the references of its steps are slow, so by default the test takes only some
/// bases.
#[test]
fn powers() {
    let step = by_form(7, 1);
    for_all(|r| {
        for a in (0..=r.f.mask()).step_by(step) {
            for b in (0..=r.f.mask()).step_by(step) {
                same(r, "pow", &[a, b], ops::pow(r.f.tininess(r.tininess), a, b), r.pow(a, b));
            }
        }
    });
}

/// All triples with `CROSSBAR_FULL=1`, otherwise a sample.
#[test]
fn multiply_add() {
    let step = by_form(61, 1);
    for_all(|r| {
        let f = r.f.tininess(r.tininess);
        let width = r.f.width();
        for triple in (0..1u32 << (3 * width)).step_by(step) {
            let [a, b, c] = [triple, triple >> width, triple >> (2 * width)].map(|t| t & r.f.mask());
            let (x, y, z) = (r.val(a), r.val(b), r.val(c));
            same(r, "fused_mad", &[a, b, c], ops::fused_mad(f, a, b, c), r.fused(x, y, z));
            let product = r.mul(x, y);
            let sum = r.add(r.val(product.bits), z).also(product.flags);
            same(r, "mad", &[a, b, c], ops::mad(f, a, b, c), sum);
        }
    });
}

#[test]
fn dot_products() {
    let rounds = by_form(300, 50_000);
    for_all(|r| {
        let mut cases = Random::new(11);
        for round in 0..rounds {
            let random = cases.next();
            let terms: [(u32, u32); 4] = std::array::from_fn(|i| {
                let bits = (random >> (16 * i)) as u32;
                (bits & r.f.mask(), bits >> 8 & r.f.mask())
            });
            let terms = &terms[..2 + round % 3];
            for order in [DotOrder::Sequential, DotOrder::Tree, DotOrder::Exact] {
                let found = ops::dot(r.f.tininess(r.tininess), order, terms);
                let expected = r.dot(&r.f, order, terms);
                assert!(found == expected, "{} {order:?} {terms:x?}: found {found:x?}, expected {expected:x?}", r.f);
            }
        }
    });
}

/// Sums in accumulators that are wider, narrower, and of another kind than the operands.
#[test]
fn accumulated_dot_products() {
    let rounds = by_form(100, 5_000);
    let accumulators = ["e5m10", "e3m2:rup", "e4m3fn:sat", "e2m1fn", "s7.8:rod", "s2.1:wrap", "n3.4:rna"];
    let accumulators = accumulators.map(|text| text.parse::<Format>().expect("a format"));
    let defaults =
        formats().into_iter().filter(|f| f.specials == Specials::Ieee && f.rounding == Rounding::NearestEven);
    defaults.collect::<Vec<_>>().par_iter().for_each(|&f| {
        let mut cases = Random::new(13);
        for round in 0..rounds {
            let random = cases.next();
            let bits = |shift: usize| (random >> shift) as u32 & f.mask();
            let terms: [(u32, u32); 4] = std::array::from_fn(|i| (bits(16 * i), bits(16 * i + 8)));
            let terms = &terms[..2 + round % 3];
            for accumulator in accumulators {
                let sums = Reference { f: accumulator, tininess: Tininess::After };
                for order in [DotOrder::Sequential, DotOrder::Tree, DotOrder::Exact] {
                    let sum = sums.dot(&f, order, terms);
                    let result = Reference { f, tininess: Tininess::After };
                    let expected = result.convert_from(&accumulator, sum.bits).also(sum.flags);
                    let found = ops::dot_accumulated(f, accumulator, order, terms);
                    assert!(found == expected, "{f} in {accumulator} {order:?} {terms:x?}: {found:x?}, {expected:x?}");
                }
            }
        }
    });
}

/// Converts from every format with default rules, with and without subnormals, to every format with all rules.
#[test]
fn conversions() {
    let from: Vec<Format> = formats()
        .into_iter()
        .filter(|f| f.rounding == Rounding::NearestEven && f.specials == Specials::Ieee)
        .filter(|f| f.overflow == if f.is_fixed() { Overflow::Saturate } else { Overflow::Infinity })
        .collect();
    for_all(|to| {
        for from in &from {
            for bits in 0..=from.mask() {
                let found = ops::convert(from, to.f.tininess(to.tininess), bits);
                let expected = to.convert_from(from, bits);
                assert!(found == expected, "{from} {bits:x} to {}: {found:x?}, expected {expected:x?}", to.f);
            }
        }
    });
}

/// Quotients of integers of any length, and truncated magnitudes, against cross products.
#[test]
fn ratios_and_parts() {
    let rounds = by_form(400, 100_000);
    for_all(|r| {
        if r.f.overflow == Overflow::Wrap {
            return;
        }
        let mut cases = Random::new(5);
        for _ in 0..rounds {
            let choice = cases.next();
            let wide = |cases: &mut Random, bits: u64| {
                let raw = u128::from(cases.next()) << 64 | u128::from(cases.next());
                (raw >> (127 - bits % 128)).max(1)
            };
            let (num, den) =
                (wide(&mut cases, choice), wide(&mut cases, choice.wrapping_add(choice >> 7 & 15).wrapping_sub(6)));
            let negative = choice >> 60 & 1 == 1;
            let (n, d) = (BigUint::from(num), BigUint::from(den));
            let expected = rational::round(&r.f, r.tininess, negative, |c| {
                (&n * c.d.unsigned_abs()).cmp(&(&d * c.n.unsigned_abs()))
            });
            let found = from_ratio(r.f.tininess(r.tininess), negative, num, den);
            assert!(found == expected, "{} {num}/{den}: {found:x?}, expected {expected:x?}", r.f);
            // num * 2^exp, possibly with further digits.
            let exp = -(128 - num.leading_zeros().cast_signed()) + (choice >> 20 & 15) as i32 - 8;
            let sticky = choice >> 40 & 1 == 1 && num >> 100 != 0;
            let found = from_parts(r.f.tininess(r.tininess), negative, num, exp, sticky);
            let expected = rational::round(&r.f, r.tininess, negative, |c| {
                let order = if exp >= 0 {
                    ((&n << exp) * c.d.unsigned_abs()).cmp(&BigUint::from(c.n.unsigned_abs()))
                } else {
                    (&n * c.d.unsigned_abs()).cmp(&(BigUint::from(c.n.unsigned_abs()) << -exp))
                };
                if sticky && order.is_eq() { Ordering::Greater } else { order }
            });
            assert!(found == expected, "{} {num}*2^{exp} {sticky}: {found:x?}, expected {expected:x?}", r.f);
        }
    });
}
