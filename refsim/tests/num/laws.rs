//! Properties of all formats and values.

use proptest::prelude::*;
use refsim::num::decimal::{from_decimal, to_decimal, to_decimal_exact};
use refsim::num::{Denormals, Format, Outcome, Overflow, Rounding, Specials, ops, unpack};

fn rounding() -> impl Strategy<Value = Rounding> {
    prop::sample::select(Rounding::ALL.map(|(_, rounding)| rounding).to_vec())
}

fn fixed() -> impl Strategy<Value = Format> {
    (0u8..=31, 0u8..=31, rounding(), prop_oneof![Just(Overflow::Saturate), Just(Overflow::Wrap)])
        .prop_filter_map("too wide", |(i, f, r, o)| Some(Format::fixed(i, f)?.with_rounding(r).with_overflow(o)))
}

fn normalized() -> impl Strategy<Value = Format> {
    (0u8..=13, 2u8..=8, rounding(), prop_oneof![Just(Overflow::Saturate), Just(Overflow::Wrap)])
        .prop_filter_map("too wide", |(i, f, r, o)| Some(Format::normalized(i, f)?.with_rounding(r).with_overflow(o)))
}

fn float() -> impl Strategy<Value = Format> {
    let overflow = prop_oneof![Just(Overflow::Infinity), Just(Overflow::Saturate), Just(Overflow::Nv30)];
    (2u8..=8, 1u8..=23, rounding(), overflow, any::<(bool, bool)>()).prop_map(|(x, m, r, o, (flush, nv))| {
        let f = Format::float(x, m).expect("in range").with_rounding(r).with_overflow(o);
        f.with_denormals(if flush { Denormals::Flush } else { Denormals::Keep }).with_specials(if nv {
            Specials::Nv
        } else {
            Specials::Ieee
        })
    })
}

fn format() -> impl Strategy<Value = Format> {
    prop_oneof![
        fixed(),
        normalized(),
        float(),
        prop_oneof![Just(Format::S3_12), Just(Format::FP16), Just(Format::FP24), Just(Format::FP32)]
    ]
}

/// Patterns with a likely carry, edge or special value; masked to the width on use.
fn pattern() -> impl Strategy<Value = u32> {
    prop_oneof![
        any::<u32>(),
        (0u32..32, any::<bool>()).prop_map(|(s, not)| if not { !(1 << s) } else { 1 << s }),
        (0u32..32).prop_map(|s| u32::MAX >> s),
        (0u32..32).prop_map(|s| u32::MAX << s),
    ]
}

fn not_wrapping(f: &Format) -> bool {
    f.overflow != Overflow::Wrap
}

/// Returns `true` if `a <= b`.
fn le(f: &Format, a: u32, b: u32) -> bool {
    ops::le_quiet(f, a, b).bits == 1
}

/// A value passed through `cmp`: NaN becomes canonical, and subnormals are flushed if the format flushes them.
fn moved(f: Format, a: u32) -> u32 {
    ops::cmp(f, 0, a, a).bits
}

fn plus(f: Format, a: u32, c: u32) -> Outcome {
    ops::add(f, a, c)
}

fn times_one_plus(f: Format, a: u32, c: u32) -> Outcome {
    ops::fused_mad(f, a, f.one(), c)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

    #[test]
    fn strings_read_back(f in format()) {
        prop_assert_eq!(f.to_string().parse::<Format>(), Ok(f));
    }

    #[test]
    fn any_string_is_a_format_or_an_error(text in "[sefpbx0-9.m:a-z]{0,24}") {
        if let Ok(f) = text.parse::<Format>() {
            prop_assert_eq!(f.to_string().parse::<Format>(), Ok(f));
        }
    }

    #[test]
    fn any_text_is_a_number_or_an_error(f in format(), text in "[-+.0-9eEinfa ]{0,40}") {
        let _ = from_decimal(f, &text);
    }

    #[test]
    fn results_stay_inside_the_width(f in format(), a in pattern(), b in pattern(), c in pattern(), k in -300i32..300) {
        let dot = ops::dot(f, ops::DotOrder::Exact, &[(a, b), (b, c), (c, a)]);
        for o in [
            ops::add(f, a, b), ops::sub(f, a, b), ops::mul(f, a, b), ops::div(f, a, b), ops::fused_mad(f, a, b, c),
            ops::mad(f, a, b, c), ops::min(f, a, b), ops::max(f, a, b), ops::cmp(f, a, b, c), ops::cnd(f, a, b, c),
            ops::sqrt(f, a), ops::rcp(f, a), ops::rsq(f, a), ops::exp2(f, a), ops::log2(f, a), ops::pow(f, a, b),
            ops::floor(f, a), ops::frc(f, a), ops::round_to_int(f, a), ops::neg(f, a), ops::abs(f, a),
            ops::saturate01(f, a), ops::scale(f, a, k), dot,
        ] {
            prop_assert_eq!(o.bits & !f.mask(), 0);
            prop_assert!(!f.is_nan(o.bits) || Some(o.bits) == f.canonical_nan());
            prop_assert!(f.denormals == Denormals::Keep || !f.is_subnormal(o.bits));
        }
    }

    /// A larger operand never yields a smaller result, under any rounding.
    #[test]
    fn rounding_is_monotone(f in format().prop_filter("wraps", not_wrapping), a in pattern(), b in pattern(), c in pattern()) {
        if le(&f, a, b) {
            for op in [plus as fn(Format, u32, u32) -> Outcome, times_one_plus] {
                let (low, high) = (op(f, a, c).bits, op(f, b, c).bits);
                prop_assert!(f.is_nan(low) || f.is_nan(high) || le(&f, low, high));
            }
            for (low, high) in [
                (ops::floor(f, a), ops::floor(f, b)),
                (ops::round_to_int(f, a), ops::round_to_int(f, b)),
                (ops::saturate01(f, a), ops::saturate01(f, b)),
                (ops::exp2(f, a), ops::exp2(f, b)),
            ] {
                prop_assert!(le(&f, low.bits, high.bits));
            }
        }
    }

    #[test]
    fn decimals_read_back(f in format(), a in pattern()) {
        let wanted = moved(f, a);
        // Most normalized numbers have no finite decimal expansion.
        let exact = f.denominator() == 1 || to_decimal_exact(&f, a).parse::<i32>().is_ok();
        // Rounded to odd, an inexact result has an odd pattern.
        prop_assume!(exact || f.rounding != Rounding::Odd);
        for text in [to_decimal(&f, a)].into_iter().chain(exact.then(|| to_decimal_exact(&f, a))) {
            prop_assert_eq!(from_decimal(f, &text).expect("a number").bits, wanted, "{}", text);
        }
    }

    #[test]
    fn exact_decimals_are_exact(f in format(), a in pattern()) {
        if f.is_finite(a) && f.denominator() == 1 {
            let outcome = from_decimal(f, &to_decimal_exact(&f, a)).expect("a number");
            prop_assert!(outcome.flags.is_empty());
            prop_assert_eq!(unpack(&f, outcome.bits), unpack(&f, a));
        }
    }

    /// The standard library's parser rounds correctly and its printer writes the shortest text, as ours do.
    #[test]
    fn decimals_of_fp32_agree_with_the_library(a in any::<u32>(), text in "[-]?[0-9]{1,30}([.][0-9]{0,30})?(e[-+]?[0-9]{1,2})?") {
        let x = f32::from_bits(a);
        if x.is_finite() {
            let ours = to_decimal(&Format::FP32, a);
            let count = |s: &str| {
                let digits: String = s.split('e').next().unwrap_or("").chars().filter(char::is_ascii_digit).collect();
                digits.trim_start_matches('0').trim_end_matches('0').len()
            };
            prop_assert_eq!(ours.parse::<f32>().map(f32::to_bits), Ok(a));
            prop_assert_eq!(count(&ours), count(&format!("{x:e}")), "{} {:e}", ours, x);
        }
        let host = text.parse::<f32>().expect("a number").to_bits();
        prop_assert_eq!(from_decimal(Format::FP32, &text).expect("a number").bits, host);
    }
}
