//! Tests the batch executor's arithmetic against `num`: two implementations that share no code must be equal for every
//! operation.
//!
//! Formats of up to 7 bits are compared exhaustively under every rounding, overflow, denormal and special-value rule,
//! and so are sums and products of fp16; wider ones on edge cases and random operands. `CROSSBAR_FULL=1` covers the
//! whole range; by default the tests cover a part of it.

use crate::environment::{by_form, is_full};
use crate::random::Random;
use rayon::prelude::*;
use refsim::exec::batch::{convert, evaluate, exact_dot};
use refsim::num::{Denormals, DotOrder, Format, NumberOperation as Op, Overflow, Rounding, Specials, ops};

/// The operations that `num` defines, except sine and cosine, for which the batch executor uses `num` itself.
fn operations() -> impl Iterator<Item = Op> {
    Op::ALL.into_iter().filter(|&op| !matches!(op, Op::Sin | Op::Cos) && op.evaluate(Format::FP32, [0; 3]).is_some())
}

fn is_unary(op: Op) -> bool {
    op.operands() == 1 || op == Op::Scale
}

/// Compares one operation on the given operands; panics at the first difference.
fn compare(f: Format, op: Op, a: &[u32], b: &[u32], c: &[u32]) {
    if op == Op::Scale {
        for power in [-3i32, -1, 1, 3] {
            compare_all(f, op, [a, &vec![power.cast_unsigned(); a.len()], c]);
        }
    } else {
        compare_all(f, op, [a, b, c]);
    }
}

fn compare_all(f: Format, op: Op, operands: [&[u32]; 3]) {
    let batch = evaluate(f, op, operands).unwrap_or_else(|| panic!("{f}: no lane arithmetic for {op:?}"));
    let scalar = |operands| op.evaluate(f, operands).map_or(0, |outcome| outcome.bits);
    same(f, &format!("{op:?}"), operands, &batch, scalar);
}

/// Compares sums of three and four products, rounded once.
fn compare_dots(f: Format, operands: [&[u32]; 3]) {
    let exact = |terms: &[(u32, u32)]| ops::dot(f, DotOrder::Exact, terms).bits;
    same(f, "three products", operands, &exact_dot(f, 3, operands), |[a, b, c]| exact(&[(a, b), (b, c), (c, a)]));
    same(f, "four products", operands, &exact_dot(f, 4, operands), |[a, b, c]| {
        exact(&[(a, b), (b, c), (c, a), (b, b)])
    });
}

fn same(f: Format, what: &str, [a, b, c]: [&[u32]; 3], batch: &[u32], scalar: impl Fn([u32; 3]) -> u32) {
    assert_eq!(batch.len(), a.len(), "{f} {what}: a result each");
    for i in 0..a.len() {
        let operands = [a[i], b[i], c[i]];
        let scalar = scalar(operands);
        assert_eq!(batch[i], scalar, "{f} {what} {operands:#x?}: batch {:#x}, scalar {scalar:#x}", batch[i]);
    }
}

/// The layout with every combination of rules of its kind.
pub(crate) fn variants(base: Format) -> Vec<Format> {
    let mut out = Vec::new();
    for (_, rounding) in Rounding::ALL {
        let Ok(f) = base.with_rounding(rounding).for_registers() else { continue };
        if f.is_fixed() {
            out.push(f.with_overflow(Overflow::Saturate));
            out.push(f.with_overflow(Overflow::Wrap));
            continue;
        }
        for overflow in [Overflow::Infinity, Overflow::Saturate, Overflow::Nv30] {
            for denormals in [Denormals::Keep, Denormals::Flush] {
                for specials in [Specials::Ieee, Specials::Nv] {
                    out.push(f.with_overflow(overflow).with_denormals(denormals).with_specials(specials));
                }
            }
        }
    }
    out
}

impl Random {
    /// A random pattern: uniform, near an edge, or near a power of two.
    fn pattern(&mut self, f: &Format) -> u32 {
        let r = self.next();
        let any = (self.next() >> 20) as u32 & f.mask();
        let near = (r >> 8 & 7) as u32;
        let edges =
            [0, f.one(), f.max_finite(), f.min_finite(), f.sign_bit(), f.one() / 2, f.infinity(false).unwrap_or(1)];
        match r & 15 {
            0 => f.mask() & edges[(r >> 32) as usize % edges.len()].wrapping_add(near),
            1 => f.mask() & edges[(r >> 32) as usize % edges.len()].wrapping_sub(near),
            2 => any & near,
            3 if f.is_fixed() => any >> (r >> 32 & 15),
            // Exponents around one: sums cancel, products stay in range.
            3..=7 if !f.is_fixed() => (f.one() ^ any & (f.one() >> 2 | f.sign_bit() | 0xff)) & f.mask(),
            _ => any,
        }
    }

    fn patterns(&mut self, f: &Format, n: usize) -> Vec<u32> {
        (0..n).map(|_| self.pattern(f)).collect()
    }
}

pub(crate) fn layout(text: &str) -> Format {
    text.parse().unwrap_or_else(|e| panic!("{text}: {e}"))
}

#[test]
fn short_formats_agree_on_all_pairs() {
    let layouts: &[&str] = if is_full() {
        &[
            "s0.1", "s1.1", "s2.0", "s0.4", "s3.4", "s7.0", "s2.5", "n0.2", "n2.3", "n0.6", "e2m1", "e2m3", "e3m2",
            "e2m1fn", "e3m2fn", "e4m3fn", "e5m2fnuz", "e3m2fnuz", "e4m3", "e5m2", "e3m4", "e2m5", "e6m1",
        ]
    } else {
        &["s0.1", "s2.0", "s2.3", "n0.2", "n2.3", "e2m1", "e2m3", "e3m2", "e4m1", "e2m1fn", "e3m3fn", "e2m3fnuz"]
    };
    for text in layouts {
        for f in variants(layout(text)) {
            let all: Vec<u32> = (0..=f.mask()).collect();
            let n = all.len();
            let mut random = Random::new(f.mask().into());
            for op in operations() {
                if is_unary(op) {
                    compare(f, op, &all, &all, &all);
                    continue;
                }
                let a: Vec<u32> = (0..n * n).map(|i| all[i / n]).collect();
                let b: Vec<u32> = (0..n * n).map(|i| all[i % n]).collect();
                let c = random.patterns(&f, n * n);
                compare(f, op, &a, &b, &c);
                if op == Op::Mul {
                    compare_dots(f, [&a, &b, &c]);
                }
            }
        }
    }
}

#[test]
fn all_formats_agree_on_random_operands() {
    let layouts = "s3.12 s1.10 s0.8 s0.15 s15.0 s7.8 s8.8 s0.31 s31.0 s15.16 s7.16 n3.8 n0.8 n7.8 n13.2 n2.7 \
                   e5m10 e7m16 e8m23 e8m7 e3m4 e8m10 e6m10 e7m10 e6m9 e5m11 e8m16 e2m23 e8m1 e7m23 e4m3fn \
                   e5m2fnuz e7m23fn e7m16fnuz e2m3fn";
    let n = by_form(512, 65536);
    for (seed, text) in layouts.split(' ').enumerate() {
        for (k, f) in variants(layout(text)).into_iter().enumerate() {
            let mut random = Random::new((seed * 64 + k + 1) as u64);
            let (a, b, c) = (random.patterns(&f, n), random.patterns(&f, n), random.patterns(&f, n));
            for op in operations() {
                compare(f, op, &a, &b, &c);
            }
            compare_dots(f, [&a, &b, &c]);
        }
    }
}

#[test]
fn sixteen_bit_formats_agree_on_all_operands_of_unary_operations() {
    let stride = by_form(97, 1);
    for f in
        ["fp16", "bf16", "s3.12", "s0.15", "n3.8", "n7.8", "n9.6"].into_iter().flat_map(|text| variants(layout(text)))
    {
        let all: Vec<u32> = (0..=f.mask()).step_by(stride).collect();
        for op in operations() {
            if is_unary(op) {
                compare(f, op, &all, &all, &all);
            }
        }
    }
}

/// All pairs of NV2x register values with `CROSSBAR_FULL=1`; by default every thirteenth first operand.
#[test]
fn normalized_registers_agree_on_pairs() {
    let step = by_form(13, 1);
    for text in ["n3.8:rna", "n3.8:rtz", "n3.8:rdn", "n0.8:rna", "n3.8:rne:wrap"] {
        let f = layout(text);
        let all: Vec<u32> = (0..=f.mask()).collect();
        (0..=f.mask()).step_by(step).collect::<Vec<_>>().into_par_iter().for_each(|a| {
            let (a, c) = (vec![a; all.len()], Random::new(a.into()).patterns(&f, all.len()));
            for op in [Op::Add, Op::Mul, Op::Div, Op::Mad, Op::FusedMad] {
                compare(f, op, &a, &all, &c);
            }
        });
    }
}

/// Sums and products of all pairs of fp16; by default every 997th first and every 61st second operand.
fn fp16_agrees_on_pairs(rules: &str) {
    let f = layout(&format!("fp16:{rules}"));
    let (first, second) = by_form((997, 61), (1, 1));
    let all: Vec<u32> = (0..=0xffff).step_by(second).collect();
    (0..=0xffff_u32).step_by(first).collect::<Vec<_>>().into_par_iter().for_each(|a| {
        let a = vec![a; all.len()];
        compare(f, Op::Add, &a, &all, &all);
        compare(f, Op::Mul, &a, &all, &all);
    });
}

/// One test per rule, so that each can be run in full by name.
macro_rules! fp16_pairs {
    ($($test:ident = $rules:literal,)*) => {
        mod fp16_pairs {
            $(#[test] fn $test() { super::fp16_agrees_on_pairs($rules); })*
        }
    };
}

fp16_pairs! {
    rne_inf_keep = "rne:inf:keep", rne_sat_keep = "rne:sat:keep", rne_nvovf_keep = "rne:nvovf:keep",
    rna_inf_keep = "rna:inf:keep", rna_sat_keep = "rna:sat:keep", rna_nvovf_keep = "rna:nvovf:keep",
    rtz_inf_keep = "rtz:inf:keep", rtz_sat_keep = "rtz:sat:keep", rtz_nvovf_keep = "rtz:nvovf:keep",
    rdn_inf_keep = "rdn:inf:keep", rdn_sat_keep = "rdn:sat:keep", rdn_nvovf_keep = "rdn:nvovf:keep",
    rne_inf_ftz = "rne:inf:ftz", rne_sat_ftz = "rne:sat:ftz", rne_nvovf_ftz = "rne:nvovf:ftz",
    rna_inf_ftz = "rna:inf:ftz", rna_sat_ftz = "rna:sat:ftz", rna_nvovf_ftz = "rna:nvovf:ftz",
    rtz_inf_ftz = "rtz:inf:ftz", rtz_sat_ftz = "rtz:sat:ftz", rtz_nvovf_ftz = "rtz:nvovf:ftz",
    rdn_inf_ftz = "rdn:inf:ftz", rdn_sat_ftz = "rdn:sat:ftz", rdn_nvovf_ftz = "rdn:nvovf:ftz",
}

/// Patterns at the limits of a float format: limits of its range and of its subnormals; mantissas that cause ties, at
/// exponents whose products are near those limits; infinities and NaN with several payloads.
fn edges(exp_bits: u32, man_bits: u32) -> Vec<u32> {
    let (top, bias) = ((1u32 << exp_bits) - 1, (1u32 << (exp_bits - 1)) - 1);
    let (half, all) = (1u32 << (man_bits - 1), (1u32 << man_bits) - 1);
    let near = [bias, bias / 2, bias + bias / 2, bias.saturating_sub(man_bits), bias.saturating_sub(man_bits) / 2];
    let fields = near.into_iter().flat_map(|e| [e.saturating_sub(1), e, e + 1]).chain([0, 1, 2, top - 2, top - 1, top]);
    let mantissas = [0, 1, half - 1, half, half + 1, all - 1, all];
    let sign = 1 << (exp_bits + man_bits);
    let mut patterns: Vec<u32> = fields
        .filter(|&e| e <= top)
        .flat_map(|e| mantissas.map(|man| e << man_bits | man))
        .flat_map(|bits| [bits, bits | sign])
        .collect();
    patterns.sort_unstable();
    patterns.dedup();
    patterns
}

/// By default, every fifth second operand, with a different start for each rule.
#[test]
fn wide_floats_agree_at_their_edges() {
    for (exp_bits, man_bits) in [(8, 23), (7, 16), (8, 10), (8, 7), (7, 22), (6, 10), (8, 22), (5, 10)] {
        let base = layout(&format!("e{exp_bits}m{man_bits}"));
        let all = edges(exp_bits, man_bits);
        variants(base).into_par_iter().enumerate().filter(|(_, f)| is_full() || f.specials == Specials::Ieee).for_each(
            |(k, f)| {
                let step = by_form(5, 1);
                let b: Vec<u32> = all.iter().copied().skip(k % step).step_by(step).collect();
                let c: Vec<u32> = b.iter().rev().copied().collect();
                for &a in &all {
                    let a = vec![a; b.len()];
                    for op in [Op::Add, Op::Sub, Op::Mul, Op::Mad, Op::Div, Op::FusedMad] {
                        compare(f, op, &a, &b, &c);
                    }
                }
            },
        );
    }
}

/// NV30's binary32 equals the host's up to the largest number; between that and 2^128 it stays finite.
#[test]
fn single_floats_agree_at_their_largest_and_smallest() {
    let near = |exponent: u32| {
        let power = exponent << 23;
        [power - 2, power - 1, power, power + 1, power + 2, power + 0x40_0000]
    };
    let exponents = [1, 24, 63, 64, 126, 127, 128, 190, 191, 192, 229, 230, 231, 253, 254, 255];
    let magnitudes = exponents.into_iter().flat_map(near).chain([0, 1, 2, 0x7f_ffff, 0x7fc0_0000]);
    let all: Vec<u32> = magnitudes.flat_map(|bits| [bits, bits | 0x8000_0000]).collect();
    for text in ["fp32:ftz:nvovf:nv", "fp32:nvovf", "fp32:ftz", "fp32:nvovf:rtz", "fp32:rtz", "fp32:rdn", "fp32:rna"] {
        let f = layout(text);
        for &a in &all {
            let first = vec![a; all.len()];
            for op in [Op::Add, Op::Sub, Op::Mul, Op::Mad, Op::Div, Op::FusedMad] {
                compare(f, op, &first, &all, &all);
                let opposite: Vec<u32> = all.iter().map(|b| b ^ 0x8000_0000).collect();
                compare(f, op, &first, &all, &opposite);
            }
        }
    }
}

#[test]
fn conversions_agree() {
    let texts = "s3.12 s3.12:rna s3.12:rtz:wrap s3.12:rdn s3.12:rne:wrap s3.12:rna:wrap s3.12:rdn:wrap \
                 n3.8 n3.8:rna n3.8:rtz n3.8:rdn:wrap n0.8:rdn n7.8:rna:wrap n0.5:rtz s1.10 s0.8:wrap s0.31 s31.0:wrap s15.16:rtz fp16 fp16:rtz fp16:ftz fp16:nvovf fp24 \
                 fp24:rdn fp24:sat fp32 fp32:ftz fp32:ftz:nvovf:nv fp32:rdn bf16 e3m4 e8m10:rna \
                 s3.12:rup s0.8:rup n3.8:rup:wrap fp16:rup fp16:rod fp32:rod e4m3fn e4m3fn:sat e5m2fnuz e2m1fn";
    let layouts: Vec<Format> = texts.split(' ').map(layout).collect();
    let n = by_form(1000, 100_000);
    for &from in &layouts {
        for &to in &layouts {
            let bits = Random::new(u64::from(from.mask()) * 31 + u64::from(to.width())).patterns(&from, n);
            let batch = convert(from, to, &bits);
            for (&bits, &result) in bits.iter().zip(&batch) {
                let scalar = ops::convert(&from, to, bits).bits;
                assert_eq!(result, scalar, "{from} to {to}: {bits:#x}: batch {result:#x}, scalar {scalar:#x}");
            }
        }
    }
}
