//! Decoding of texels.

use super::rational::{Rational, assert_nearest};
use refsim::num::Format;
use refsim::texture::{ChannelClass, SignedTexelMinimum, TargetRounding, TexelFormat, decode, decode_channel, encode};

const FORMATS: [Format; 4] = [Format::S3_12, Format::FP16, Format::FP24, Format::FP32];

/// The definition of a normalised channel, implemented again.
fn exact(class: ChannelClass, bits: u8, code: u32, minimum: SignedTexelMinimum) -> Rational {
    let signed = |code: u32| i64::from(code) - if code >> (bits - 1) == 1 { 1i64 << bits } else { 0 };
    match class {
        ChannelClass::Unorm => Rational::new(code, (1u64 << bits) - 1),
        ChannelClass::Snorm => {
            let (v, whole) = (signed(code), (1i64 << (bits - 1)) - 1);
            let v = if minimum == SignedTexelMinimum::Clamp { v.max(-whole) } else { v };
            Rational::new(v, whole)
        }
        _ => {
            let v = signed(code);
            Rational::new(v, if v < 0 { 16 } else { 15 })
        }
    }
}

#[test]
fn every_code_of_every_channel_is_rounded_once() {
    for &format in TexelFormat::ALL {
        for channel in format.record().stored() {
            if matches!(channel.class, ChannelClass::Float(_)) {
                continue;
            }
            let step = if channel.bits > 11 { 97 } else { 1 };
            let last = u32::MAX >> (32 - channel.bits);
            for code in (0..last).step_by(step).chain([last, last / 2, last / 2 + 1]) {
                for minimum in [SignedTexelMinimum::Clamp, SignedTexelMinimum::BelowMinusOne] {
                    let value = decode_channel(*channel, code, minimum);
                    let want = exact(channel.class, channel.bits, code, minimum);
                    for to in FORMATS {
                        assert_nearest(to, value.to_format(to), &want, &format!("{format} code {code:#x} in {to}"));
                    }
                }
            }
        }
    }
}

#[test]
fn float_texels_come_back_as_they_were_stored() {
    for (texel, format) in [(TexelFormat::R16f, Format::FP16), (TexelFormat::R24f, Format::FP24)] {
        for bits in (0..=format.mask()).step_by(if format.width() > 16 { 101 } else { 1 }) {
            let raw = encode(texel, format, [bits, 0, 0, 0], TargetRounding::Nearest);
            let back = decode(texel, raw, SignedTexelMinimum::Clamp).to_format(format);
            let want = if format.is_nan(bits) { format.canonical_nan().unwrap() } else { bits };
            assert_eq!(back, [want, format.one(), format.one(), format.one()], "{texel} {bits:#x}");
        }
    }
}

// Wine's test_signed_formats: R200 decodes -128 below -1, others clamp; a switch selects either.
#[test]
fn minus_128_under_both_switches() {
    let value = |minimum, format| decode(TexelFormat::Rg8Snorm, 0x0080, minimum).to_format(format)[0];
    assert_eq!(value(SignedTexelMinimum::Clamp, Format::S3_12), 0xf000);
    assert_eq!(value(SignedTexelMinimum::BelowMinusOne, Format::S3_12), 0xefe0); // -4128.25 / 4096
    assert_eq!(value(SignedTexelMinimum::Clamp, Format::FP32), (-1.0f32).to_bits());
    assert_eq!(value(SignedTexelMinimum::BelowMinusOne, Format::FP32), (-128.0f32 / 127.0).to_bits());
}

// Wine's test of L6V5U5: -15 is not -1.0, L is k/63.
#[test]
fn l6v5u5_as_wine_measured_it() {
    let texel = |u: i32, v: i32, l: u32| {
        let raw = (u & 31) as u128 | ((v & 31) as u128) << 5 | u128::from(l) << 10;
        decode(TexelFormat::L6v5u5, raw, SignedTexelMinimum::Clamp).to_format(Format::FP32).map(f32::from_bits)
    };
    assert_eq!(texel(-15, -16, 63), [-15.0 / 16.0, -1.0, 1.0, 1.0]);
    assert_eq!(texel(15, 7, 0), [1.0, 7.0 / 15.0, 0.0, 1.0]);
    assert_eq!(texel(-1, 0, 21), [-1.0 / 16.0, 0.0, 1.0 / 3.0, 1.0]);
}
