use crossbar_base::compare::{Number, ulps};

fn number(format: &str, bits: u32) -> Number {
    Number { format: format.parse().expect("a format"), bits }
}

#[test]
fn one_layout_counts_steps() {
    let apart = |format: &str, a, b| ulps(&number(format, a), &number(format, b)).0;
    assert_eq!(apart("fp32", 0x3f80_0000, 0x3f80_0001), Some(1.0));
    assert_eq!(apart("fp32", 0x8000_0001, 0x0000_0001), Some(2.0), "over both zeros");
    assert_eq!(apart("fp32", 0x8000_0000, 0), Some(0.0));
    assert_eq!(apart("s3.12", 0xffff, 0x0001), Some(2.0));
    assert_eq!(apart("fp16", 0x7bff, 0x7c00), None, "infinity is no number of steps away");
    assert_eq!(apart("fp16", 0x7c00, 0x7c00), Some(0.0));
}

#[test]
fn zeros_of_two_signs_differ_in_one_layout_only() {
    assert!(!number("fp32", 0).equals(&number("fp32:rtz", 0x8000_0000)));
    assert!(number("fp32", 0x8000_0000).equals(&number("s3.12", 0)));
    assert!(number("fp32", 0x7fc0_0000).equals(&number("fp16", 0x7e00)), "NaN");
}

#[test]
fn two_layouts_count_in_the_coarser_one() {
    // 1 + 2^-12 and 1 + 2^-10 differ by 3/4 of fp16's last place, 2^-10.
    let (apart, unit) = ulps(&number("fp32", 0x3f80_0800), &number("fp16", 0x3c01));
    assert_eq!((apart, unit.to_string().as_str()), (Some(0.75), "e5m10"));
    // Near 0.001 the last place of s3.12 is larger than that of fp16.
    let (apart, unit) = ulps(&number("s3.12", 4), &number("fp16", 0x1400));
    assert_eq!((apart, unit.to_string().as_str()), (Some(0.0), "s3.12"));
    let (apart, unit) = ulps(&number("s3.12", 4), &number("fp16", 0x1401));
    assert_eq!(unit.to_string(), "s3.12");
    // 2^-10 (1 + 2^-10) - 2^-10 = 2^-20, in units of 2^-12.
    assert_eq!(apart, Some(1.0 / 256.0));
}

#[test]
fn doubles_are_exact() {
    assert_eq!(number("fp32", 1).double(), f64::from(f32::from_bits(1)));
    assert_eq!(number("s15.16", 0x8000_0000).double(), -32768.0);
    assert_eq!(number("s3.12", 0x0555).double(), 1365.0 / 4096.0);
    assert_eq!(number("fp16:ftz", 1).double(), f64::from(f32::from_bits(0x3380_0000)), "as stored");
}
