//! Values of `refsim::num` that can be verified manually.

use refsim::num::decimal::from_decimal;
use refsim::num::{Format, FormatError};

fn read(f: &Format, text: &str) -> u32 {
    from_decimal(f, text).expect("a number").bits
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
    let wrong = "s16.16 e9m3 e8m7fn e8m7fnuz e8m0fn e4m0 s3.12fn s3.12:up fp16:wrap s3.12:nv fp16:rtz:rne";
    for text in wrong.split(' ').chain([""]) {
        assert!(text.parse::<Format>().is_err(), "{text}");
    }
    assert!(matches!("s3.12:up".parse::<Format>(), Err(FormatError::Suffix { at: 5, .. })));
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
