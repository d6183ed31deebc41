//! Values of `refsim::num` that can be verified manually.

use refsim::num::decimal::{from_decimal, to_decimal, to_decimal_exact};
use refsim::num::{DotOrder, Flags, Format, FormatError, Outcome, Tininess, from_ratio, ops};

fn read(f: &Format, text: &str) -> u32 {
    from_decimal(f, text).expect("a number").bits
}

#[track_caller]
fn same(f: &Format, found: Outcome, text: &str) {
    assert_eq!(to_decimal(f, found.bits), text, "{f}: bits {:#x}", found.bits);
}

#[test]
fn float_values() {
    let f = &Format::FP16;
    let n = |t: &str| read(f, t);
    same(f, ops::add(f, n("1"), n("2")), "3");
    same(f, ops::mul(f, n("-1.5"), n("2")), "-3");
    same(f, ops::div(f, n("1"), n("3")), "0.3333");
    same(f, ops::sqrt(f, n("2")), "1.414");
    same(f, ops::rsq(f, n("4")), "0.5");
    for negative in ["-4", "-inf"] {
        assert_eq!(ops::rsq(f, n(negative)), Outcome::new(0x7e00, Flags::INVALID));
        assert_eq!(ops::log2(f, n(negative)), Outcome::new(0x7e00, Flags::INVALID));
        assert_eq!(ops::pow(f, n(negative), n("2")), Outcome::new(0x7e00, Flags::INVALID));
    }
    assert_eq!(ops::rsq(f, n("-0")), Outcome::new(0xfc00, Flags::DIVIDE_BY_ZERO));
    same(f, ops::exp2(f, n("-3")), "0.125");
    same(f, ops::log2(f, n("8")), "3");
    same(f, ops::pow(f, n("3"), n("2")), "9");
    same(f, ops::floor(f, n("-1.5")), "-2");
    same(f, ops::frc(f, n("-1.25")), "0.75");
    same(f, ops::frc(f, n("-0.00001")), "1");
    same(f, ops::scale(f, n("1.5"), -3), "0.1875");
    same(f, ops::saturate01(f, n("-3")), "0");
    same(f, ops::cmp(f, n("-0"), n("1"), n("2")), "1");
    same(f, ops::cnd(f, n("0.5"), n("1"), n("2")), "2");
    same(f, from_ratio(f, true, 128, 255), "-0.502");
    same(f, ops::add(f, n("65504"), n("16")), "inf");
    same(&Format::FP32, ops::exp2(Format::FP32, read(&Format::FP32, "0.5")), "1.4142135");
    assert_eq!(to_decimal_exact(f, 1), "0.000000059604644775390625");
    assert_eq!(ops::log2(f, 0), Outcome::new(0xfc00, Flags::DIVIDE_BY_ZERO));
    assert_eq!(ops::dot(f, DotOrder::Exact, &[(n("1"), n("65504")), (n("-1"), n("65504"))]), Outcome::exact(0));
}

#[test]
fn fixed_values() {
    let f = &Format::S3_12;
    assert_eq!(ops::add(f, 0x7000, 0x2000).bits, 0x7fff);
    let wrap = f.with_overflow(refsim::num::Overflow::Wrap);
    assert_eq!(ops::add(wrap, 0x7000, 0x2000), Outcome::new(0x9000, Flags::OVERFLOW | Flags::INEXACT));
    assert_eq!(ops::div(f, 0xf000, 0), Outcome::new(0x8000, Flags::DIVIDE_BY_ZERO));
    assert_eq!(ops::div(f, 0, 0), Outcome::new(0, Flags::INVALID));
    assert_eq!(ops::convert(&Format::FP32, f, 0x3f80_0000), Outcome::exact(0x1000));
    assert_eq!(ops::convert(&Format::FP32, f, 0x7fc0_0000), Outcome::new(0, Flags::INVALID));
    same(f, ops::floor(f, read(f, "-0.25")), "-1");
}

/// The tininess rules differ for results that round up to the smallest normal number.
#[test]
fn tininess() {
    // (2^-14 - 2^-24) * (1 + 2^-10) is below 2^-14 and rounds to it.
    let (a, b) = (0x03ff, 0x3c01);
    let after = ops::mul(Format::FP16, a, b);
    let before = ops::mul(Format::FP16.tininess(Tininess::Before), a, b);
    assert_eq!((after.bits, before.bits), (0x0400, 0x0400));
    assert_eq!(after.flags, Flags::INEXACT);
    assert_eq!(before.flags, Flags::INEXACT | Flags::UNDERFLOW);
}

#[test]
fn format_strings() {
    for (text, canonical) in [
        ("ps14", "s3.12"),
        ("fp16:rtz:ftz", "e5m10:rtz:ftz"),
        ("fx12:wrap:rdn", "s1.10:rdn:wrap"),
        ("fp32:rne:inf:keep:ieee", "e8m23"),
        ("e2m1:nvovf:nv", "e2m1:nvovf:nv"),
        ("s0.31", "s0.31"),
        ("s3.12:rup", "s3.12:rup"),
        ("fp16:rod:sat", "e5m10:rod:sat"),
        ("e4m3fn", "e4m3fn"),
        ("bf16:rst", "e8m7:rst"),
        ("e5m2fnuz:rtz", "e5m2fnuz:rtz"),
        ("e2m1fn:rne", "e2m1fn"),
        ("e7m23fn", "e7m23fn"),
        ("e8m0:sat", "e8m0:sat"),
    ] {
        let format: Format = text.parse().expect("a format");
        assert_eq!(format.to_string(), canonical);
        assert_eq!(canonical.parse::<Format>().as_ref(), Ok(&format));
    }
    let fail = |text: &str| text.parse::<Format>().expect_err("no format");
    assert!(matches!(fail(""), FormatError::Layout { .. }));
    assert!(matches!(fail("s16.16"), FormatError::Range { .. }));
    assert!(matches!(fail("e9m3"), FormatError::Range { .. }));
    assert!(matches!(fail("e8m7fn"), FormatError::Range { .. }));
    assert!(matches!(fail("e8m7fnuz"), FormatError::Range { .. }));
    assert!(matches!(fail("e8m0fn"), FormatError::Range { .. }));
    assert!(matches!(fail("e4m0"), FormatError::Range { .. }));
    assert!(matches!(fail("s3.12fn"), FormatError::Layout { .. }));
    assert!(matches!(fail("s3.12:up"), FormatError::Suffix { at: 5, .. }));
    assert!(matches!(fail("fp16:wrap"), FormatError::WrongKind { kind: "fixed point", .. }));
    assert!(matches!(fail("s3.12:nv"), FormatError::WrongKind { kind: "floats", .. }));
    assert!(matches!(fail("fp16:rtz:rne"), FormatError::Twice { rule: "rounding", .. }));
    assert_eq!(
        fail("s3.12:up").to_string(),
        "number format `s3.12:up`: expected a suffix :rne :rna :rtz :rdn :rup :rod :rst, :sat :wrap :inf :nvovf, :keep :ftz, \
         :ieee :nv or a card's unit :nv2x :nv3x-legacy :nv3x :gt200 :gt200-zero-wins, found `:up` at character 5"
    );
}

/// Data files store formats as strings.
#[test]
fn formats_in_files() {
    let table: std::collections::BTreeMap<String, Format> =
        toml::from_str("alu = \"fp24:rtz:ftz\"").expect("a table of formats");
    assert_eq!(toml::to_string(&table).as_deref(), Ok("alu = \"e7m16:rtz:ftz\"\n"));
    let bad = toml::from_str::<std::collections::BTreeMap<String, Format>>("alu = \"fp23\"");
    assert!(bad.is_err_and(|error| error.to_string().contains("number format `fp23`: expected a layout")));
}

#[test]
fn decimal_text() {
    let f = &Format::FP32;
    assert_eq!(from_decimal(f, "1e999999999").map(|o| o.bits), Ok(0x7f80_0000));
    assert_eq!(from_decimal(f, "-1e-999999999").map(|o| o.bits), Ok(0x8000_0000));
    assert_eq!(read(f, "16777217"), 0x4b80_0000);
    assert_eq!(read(f, &format!("16777217.{}1", "0".repeat(5000))), 0x4b80_0001);
    assert_eq!(read(f, ".5"), 0x3f00_0000);
    assert_eq!(read(f, "5.e-1"), 0x3f00_0000);
    assert_eq!(read(f, "-Infinity"), 0xff80_0000);
    for bad in ["", "-", ".", "1e", "1e+", "1 ", "0x10", "1.2.3", "--1", "nanx", "é"] {
        assert!(from_decimal(f, bad).is_err(), "{bad:?}");
    }
    assert_eq!(
        from_decimal(f, "1.5x").expect_err("no number").to_string(),
        "decimal number `1.5x`: expected a digit, a point, an exponent or the end at character 3, found `x`"
    );
}
