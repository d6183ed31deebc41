//! Encoding of texels, and decoding of the encoded.

use super::rational::Rational;
use num_bigint::BigInt;
use proptest::prelude::*;
use refsim::num::Format;
use refsim::texture::{
    Channel, Image, Region, SignedTexelMinimum, TargetRounding, TexelFormat, TextureError, TextureKind, decode, encode,
    encode_channel,
};

/// Reference: `clamp(value) * scale`, rounded with ties away from zero or truncated; with big integers.
fn model(format: Format, bits: u32, scale: i64, signed: bool, rounding: TargetRounding) -> i64 {
    let Some(value) = Rational::of(format, bits) else {
        let negative = format.is_negative(bits);
        return match (format.is_nan(bits), negative, signed) {
            (true, ..) | (false, true, false) => 0,
            (false, true, true) => -scale,
            (false, false, _) => scale,
        };
    };
    let (n, d) = (value.n, value.d);
    let negative = n < BigInt::from(0);
    let size = if negative { -n } else { n } * scale;
    let half = if rounding == TargetRounding::Nearest { d.clone() } else { BigInt::from(0) };
    let code: BigInt = (size * 2 + half) / (d * 2);
    let code = i64::try_from(code.min(BigInt::from(scale))).unwrap();
    match (negative, signed) {
        (true, false) => 0,
        (true, true) => -code,
        _ => code,
    }
}

fn check(channel: Channel, signed: bool, format: Format) {
    let scale = (1i64 << (channel.bits - u8::from(signed))) - 1;
    for bits in 0..=0xffff {
        for rounding in [TargetRounding::Nearest, TargetRounding::Truncate] {
            let want = model(format, bits, scale, signed, rounding) as u32 & (u32::MAX >> (32 - channel.bits));
            assert_eq!(encode_channel(channel, format, bits, rounding), want, "{format} {bits:#x} {rounding:?}");
        }
    }
}

#[test]
fn every_16_bit_value_into_unsigned_and_signed_channels() {
    for format in [Format::S3_12, Format::FP16, Format::BF16] {
        check(TexelFormat::Rgba8.record().channels[0], false, format);
        check(TexelFormat::Rg16.record().channels[0], false, format);
        check(TexelFormat::Bgra5551.record().channels[3], false, format);
        check(TexelFormat::Rg8Snorm.record().channels[1], true, format);
        check(TexelFormat::Rg16Snorm.record().channels[0], true, format);
    }
}

proptest! {
    /// Reading a region back returns the written texels, and nothing else changes.
    #[test]
    fn regions_go_where_they_should(x in 0u32..9, y in 0u32..7, width in 0u32..9, height in 0u32..7, seed in any::<u8>()) {
        let mut image = Image::new(TexelFormat::Rg16, TextureKind::Cube, [8, 8, 1], 2).unwrap();
        let region = Region { x, y, width, height };
        let bytes: Vec<u8> = (0..width * height * 4).map(|i| (i as u8).wrapping_mul(31) ^ seed | 1).collect();
        let result = image.write_region(0, 3, region, &bytes);
        if x + width > 8 || y + height > 8 {
            let refused = matches!(result, Err(TextureError::Outside { .. }));
            prop_assert!(refused);
            prop_assert!(image.bytes().iter().all(|&b| b == 0));
        } else {
            prop_assert!(result.is_ok());
            prop_assert_eq!(image.read_region(0, 3, region).unwrap(), bytes.clone());
            prop_assert_eq!(image.bytes().iter().filter(|&&b| b != 0).count(), bytes.len());
        }
    }
}

#[test]
fn impossible_images_are_refused() {
    let new = |kind, extents, levels| Image::new(TexelFormat::Rgba32f, kind, extents, levels);
    assert!(matches!(new(TextureKind::D2, [0, 1, 1], 1), Err(TextureError::Extent { .. })));
    assert!(matches!(new(TextureKind::D1, [4, 2, 1], 1), Err(TextureError::Extent { .. })));
    assert!(matches!(new(TextureKind::Cube, [4, 2, 1], 1), Err(TextureError::Extent { .. })));
    assert!(matches!(new(TextureKind::D2, [4, 4, 1], 4), Err(TextureError::Levels { most: 3, found: 4 })));
    assert!(matches!(new(TextureKind::Rectangle, [4, 4, 1], 2), Err(TextureError::Levels { .. })));
    assert!(matches!(new(TextureKind::Volume, [16_384; 3], 1), Err(TextureError::TooLarge { .. })));
    assert!(matches!(new(TextureKind::D2, [u32::MAX; 3], u32::MAX), Err(TextureError::Extent { .. })));
    let bytes = Image::from_bytes(TexelFormat::L8, TextureKind::D2, [2, 2, 1], 1, vec![0; 5]);
    assert_eq!(bytes, Err(TextureError::DataSize { unit: "bytes", expected: 4, found: 5 }));
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
