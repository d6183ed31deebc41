//! Decoding of texels.

use super::rational::{Rational, assert_nearest};
use refsim::num::Format;
use refsim::texture::{ChannelClass, SignedTexelMinimum, TargetRounding, TexelFormat, decode, decode_channel, encode};

const FORMATS: [Format; 4] = [Format::S3_12, Format::FP16, Format::FP24, Format::FP32];

/// The definition of a normalized channel, implemented independently.
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

#[test]
fn formats_have_names_of_direct3d_too() {
    assert_eq!(TexelFormat::named("D3DFMT_A8R8G8B8"), Some(TexelFormat::Bgra8));
    assert_eq!(TexelFormat::named(""), None);
}
