//! Depth formats and comparisons.

use num_bigint::BigInt;
use proptest::prelude::*;
use refsim::num::{Format, Unpacked, unpack};
use refsim::output::{CompareFunction, DepthFormat, DepthSurface, OutputError};
use refsim::texture::TargetRounding;
use std::cmp::Ordering;

/// Reference: clamps, scales and rounds with big integers.
fn model(bits: u32, scale: u64, rounding: TargetRounding) -> u32 {
    let (n, d) = match unpack(&Format::FP32, bits) {
        Unpacked::Nan { .. } | Unpacked::Inf { sign: true } | Unpacked::Finite { sign: true, .. } => return 0,
        Unpacked::Inf { sign: false } => return scale as u32,
        Unpacked::Finite { sig, exp, .. } if exp < 0 => (BigInt::from(sig), BigInt::from(1) << exp.unsigned_abs()),
        Unpacked::Finite { sig, exp, .. } => (BigInt::from(sig) << exp.unsigned_abs(), BigInt::from(1)),
    };
    let half = if rounding == TargetRounding::Nearest { d.clone() } else { BigInt::from(0) };
    let code: BigInt = (n * 2 * scale + half) / (d * 2);
    u32::try_from(code.min(BigInt::from(scale))).unwrap()
}

fn any_depth() -> impl Strategy<Value = u32> {
    prop_oneof![any::<u32>(), (0.0f32..=1.0).prop_map(f32::to_bits), (0u32..=0x3f80_0001)]
}

proptest! {
    #[test]
    fn integer_depths_are_rounded_once(bits in any_depth()) {
        for rounding in [TargetRounding::Nearest, TargetRounding::Truncate] {
            for (format, scale) in [(DepthFormat::Unorm16, 0xffff), (DepthFormat::Unorm24, 0xff_ffff), (DepthFormat::Unorm32, 0xffff_ffff)] {
                prop_assert_eq!(format.quantise(Format::FP32, bits, rounding), model(bits, scale, rounding), "{} {:#x}", format, bits);
            }
        }
    }

    /// A farther fragment never has a smaller pattern, so comparing patterns compares depths.
    #[test]
    fn patterns_order_as_depths(a in 0u32..=0x3f80_0000, b in 0u32..=0x3f80_0000) {
        for &format in DepthFormat::ALL {
            let q = |bits| format.quantise(Format::FP32, bits, TargetRounding::Nearest);
            prop_assert!(a > b || q(a) <= q(b), "{}", format);
        }
    }

    #[test]
    fn float_depths(bits in 0u32..=0x3f80_0000) {
        prop_assert_eq!(DepthFormat::Float32.quantise(Format::FP32, bits, TargetRounding::Truncate), bits);
        // 20e4 holds 20 bits: truncating the last three bits yields a number of the format, if the exponent fits.
        let short = bits & !7;
        let stored = DepthFormat::Float24.quantise(Format::FP32, short, TargetRounding::Nearest);
        prop_assert!(stored < 1 << 24);
        if short >= (127 - 14) << 23 {
            prop_assert_eq!(DepthFormat::Float24.to_format(stored, Format::FP32), short);
        }
    }

    /// Decoding and storing a stored value returns the same value.
    #[test]
    fn stored_depths_are_fixed_points(code in 0u32..0x1_0000) {
        let there = DepthFormat::Unorm16.to_format(code, Format::FP32);
        prop_assert_eq!(DepthFormat::Unorm16.quantise(Format::FP32, there, TargetRounding::Nearest), code);
    }
}

/// Ties in the last of 20 bits round to even; 0.5 has exponent field 14.
#[test]
fn float_24_rounds_to_even() {
    let q = |eighths: u32| DepthFormat::Float24.quantise(Format::FP32, 0x3f00_0000 + eighths, TargetRounding::Nearest);
    let half = 14 << 20;
    for (last_bits, want) in [(3, 0), (4, 0), (5, 1), (11, 1), (12, 2), (13, 2), (20, 2), (28, 4)] {
        assert_eq!(q(last_bits), half + want, "{last_bits} eighths");
    }
    // The carry past the mantissa reaches the exponent, and a number just below 1 becomes 1.
    assert_eq!(DepthFormat::Float24.quantise(Format::FP32, 0x3f7f_ffff, TargetRounding::Nearest), 15 << 20);
    assert_eq!(DepthFormat::Float24.quantise(Format::FP32, 0x3eff_ffff, TargetRounding::Nearest), half);
    // Subnormals: the unit is 2^-34.
    let small = |v: f32| DepthFormat::Float24.quantise(Format::FP32, v.to_bits(), TargetRounding::Nearest);
    let unit = 1.0 / (1u64 << 34) as f32;
    assert_eq!([small(unit), small(unit * 0.5), small(unit * 1.5), small(unit * 1048575.0)], [1, 0, 2, 0xf_ffff]);
}

/// The depth of texdepth, r5.r / r5.g, is converted from the register format to the depth format in one step.
#[test]
fn register_depths_are_converted_once() {
    let q = |format, bits| DepthFormat::Unorm16.quantise(format, bits, TargetRounding::Nearest);
    for bits in 0..=0x1000u32 {
        let want = (u64::from(bits) * 65535 * 2 + 4096) / 8192;
        assert_eq!(u64::from(q(Format::S3_12, bits)), want);
    }
    assert_eq!(q(Format::S3_12, 0x7fff), 0xffff);
    assert_eq!(q(Format::S3_12, 0x8000), 0);
}

#[test]
fn the_eight_comparisons() {
    use Ordering::{Equal, Greater, Less};
    let table = [
        (CompareFunction::Never, [false, false, false, false]),
        (CompareFunction::Less, [true, false, false, false]),
        (CompareFunction::Equal, [false, true, false, false]),
        (CompareFunction::LessEqual, [true, true, false, false]),
        (CompareFunction::Greater, [false, false, true, false]),
        (CompareFunction::NotEqual, [true, false, true, true]),
        (CompareFunction::GreaterEqual, [false, true, true, false]),
        (CompareFunction::Always, [true; 4]),
    ];
    assert_eq!(table.map(|(f, _)| f), CompareFunction::ALL);
    for (function, want) in table {
        let found = [Some(Less), Some(Equal), Some(Greater), None].map(|order| function.holds(order));
        assert_eq!(found, want, "{function:?}");
    }
}

#[test]
fn surfaces() {
    let mut surface = DepthSurface::new(DepthFormat::Unorm24, 3, 2).unwrap();
    assert_eq!(surface.data(), [0xff_ffff; 6]);
    surface.clear(0.5f32.to_bits(), TargetRounding::Truncate);
    assert_eq!((surface.get(2, 1), surface.get(3, 1), surface.get(0, 2)), (Some(0x7f_ffff), None, None));
    assert!(matches!(DepthSurface::new(DepthFormat::Unorm16, 0, 4), Err(OutputError::DepthExtent { .. })));
    assert!("d17".parse::<DepthFormat>().is_err());
}

#[test]
fn ends_and_specials() {
    for &format in DepthFormat::ALL {
        let q = |v: f32| format.quantise(Format::FP32, v.to_bits(), TargetRounding::Nearest);
        let one = q(1.0);
        assert_eq!((q(0.0), q(-0.0), q(-3.0), q(f32::NAN), q(f32::NEG_INFINITY)), (0, 0, 0, 0, 0), "{format}");
        assert_eq!((q(2.0), q(f32::INFINITY), q(f32::MAX)), (one, one, one), "{format}");
        assert!(q(0.25) < q(0.5) && q(0.5) < one, "{format}: order");
        assert_eq!(format.to_format(one, Format::FP32), Format::FP32.one(), "{format}");
        assert_eq!(format.name().parse::<DepthFormat>().unwrap(), format);
    }
    let q = |v: f32| DepthFormat::Float32.quantise(Format::FP32, v.to_bits(), TargetRounding::Nearest);
    assert_eq!(q(0.3), 0.3f32.to_bits());
    assert_eq!(q(1e-40), 1e-40f32.to_bits());
    assert_eq!(DepthFormat::Float24.quantise(Format::FP32, 0x3f00_0000, TargetRounding::Nearest), 14 << 20);
}
