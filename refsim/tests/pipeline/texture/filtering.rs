//! Filtered reads.

use super::addressing::{MODES, naive};
use super::rational::{Rational, assert_nearest};
use proptest::prelude::*;
use refsim::num::Format;
use refsim::texture::{
    AddressMode, ChannelValue, Filter, Image, Lod, MipFilter, SampleRules, SamplerState, SignedTexelMinimum,
    TargetRounding, TexelFormat, TextureKind, sample, unbound,
};

fn rules(format: Format) -> SampleRules {
    SampleRules { signed_texel_minimum: SignedTexelMinimum::BelowMinusOne, ..SampleRules::exact(format) }
}

fn linear(mode: AddressMode) -> SamplerState {
    SamplerState {
        min: Filter::Linear,
        mag: Filter::Linear,
        address_u: mode,
        address_v: mode,
        address_w: mode,
        ..SamplerState::default()
    }
}

fn bits(values: [f32; 4]) -> [u32; 4] {
    values.map(f32::to_bits)
}

/// Position `u * n - 1/2` on the grid of 1/256: integer texel and weight.
fn split(u: f32, n: u32) -> (i64, i64) {
    let p = Rational::of_f32(u).mul(&Rational::new(n, 1)).mul(&Rational::new(256, 1)).sub(&Rational::new(255, 2));
    let p = i64::try_from(p.floor()).unwrap(); // -128, and + 1/2 to round
    (p.div_euclid(256), p.rem_euclid(256))
}

proptest! {
    /// The exact weighted sum is rounded once, in every register format and address mode.
    #[test]
    fn bilinear_is_the_rational_sum_rounded_once(
        data in prop::collection::vec(any::<u8>(), 7 * 5 * 4),
        u in -2.0f32..2.0, v in -2.0f32..2.0,
        which in 0usize..5, mode in 0usize..4, to in 0usize..4,
    ) {
        let format = [TexelFormat::Rgba8, TexelFormat::Rg16Snorm, TexelFormat::Rg16, TexelFormat::Rgb111110, TexelFormat::X8l8v8u8][which];
        let to = [Format::S3_12, Format::FP16, Format::FP24, Format::FP32][to];
        let mode = MODES[mode];
        let image = Image::from_bytes(format, TextureKind::D2, [7, 5, 1], 1, data).unwrap();
        let found = sample(Some(&image), &linear(mode), &rules(to), bits([u, v, 0., 0.]), Lod::Base);
        let ((x, wx), (y, wy)) = (split(u, 7), split(v, 5));
        for (component, &filtered) in found.iter().enumerate() {
            let mut sum = Rational::new(0, 1);
            for (dx, dy, weight) in [(0, 0, (256 - wx) * (256 - wy)), (1, 0, wx * (256 - wy)), (0, 1, (256 - wx) * wy), (1, 1, wx * wy)] {
                let at = (naive(mode, x + dx, 7), naive(mode, y + dy, 5));
                let value = match at {
                    (Some(x), Some(y)) => image.texel(0, 0, y, x, SignedTexelMinimum::BelowMinusOne).0[component],
                    // Black border: stored components are 0; missing components have their default, 1.
                    _ => image_border(format, component),
                };
                let ChannelValue::Ratio { numerator, denominator } = value else { panic!("integer texels only") };
                sum = sum.add(&Rational::new(numerator * weight, i64::from(denominator) * 65536));
            }
            assert_nearest(to, filtered, &sum, "bilinear");
        }
    }

    /// Float texels: the FP32 steps of the definition, repeated with host floats.
    #[test]
    fn float_texels_are_lerped_in_fp32(values in prop::collection::vec(-1e6f32..1e6, 9), u in 0.0f32..1.0, v in 0.0f32..1.0) {
        let texels: Vec<_> = values.iter().map(|v| [v.to_bits(), 0, 0, 0]).collect();
        let image = Image::from_values(TexelFormat::R32f, TextureKind::D2, [3, 3, 1], Format::FP32, &texels, TargetRounding::Nearest).unwrap();
        let found = sample(Some(&image), &linear(AddressMode::Clamp), &rules(Format::FP32), bits([u, v, 0., 0.]), Lod::Base);
        let ((x, wx), (y, wy)) = (split(u, 3), split(v, 3));
        let at = |x: i64, y: i64| values[(y.clamp(0, 2) * 3 + x.clamp(0, 2)) as usize];
        let lerp = |a: f32, b: f32, w: i64| if w == 0 { a } else { a + w as f32 / 256.0 * (b - a) };
        let want = lerp(lerp(at(x, y), at(x + 1, y), wx), lerp(at(x, y + 1), at(x + 1, y + 1), wx), wy);
        prop_assert_eq!(found[0], want.to_bits());
    }
}

fn image_border(format: TexelFormat, component: usize) -> ChannelValue {
    refsim::texture::decode(format, 0, SignedTexelMinimum::Clamp).0[component]
}

/// 8x8 with four levels; level i holds 10 * i in every texel.
fn stepped(kind: TextureKind, depth: u32) -> Image {
    let mut image = Image::new(TexelFormat::L8, kind, [8, 8, depth], 4).unwrap();
    for (i, level) in image.levels().to_vec().into_iter().enumerate() {
        let end = level.offset + level.slice_bytes * level.slices as usize;
        image.bytes_mut()[level.offset..end].fill(10 * i as u8);
    }
    image
}

#[test]
fn levels_follow_the_level_of_detail() {
    for (kind, depth) in [(TextureKind::Cube, 1), (TextureKind::Volume, 8)] {
        let image = stepped(kind, depth);
        let read = |mip, filter, lod: f32, bias: f32, first| {
            let state = SamplerState {
                mip,
                min: filter,
                mag: filter,
                lod_bias: bias.to_bits(),
                max_mip_level: first,
                ..SamplerState::default()
            };
            let value = sample(
                Some(&image),
                &state,
                &rules(Format::FP32),
                bits([0.3, 0.4, 0.2, 0.]),
                Lod::Level(lod.to_bits()),
            );
            f32::from_bits(value[0]) * 255.0
        };
        for filter in [Filter::Nearest, Filter::Linear] {
            let nearest = |lod, bias, first| read(MipFilter::Nearest, filter, lod, bias, first).round();
            assert_eq!(nearest(0.4, 0.0, 0), 0.0);
            assert_eq!(nearest(0.5, 0.0, 0), 10.0);
            assert_eq!(nearest(2.2, 0.0, 0), 20.0);
            assert_eq!(nearest(99.0, 0.0, 0), 30.0);
            assert_eq!(nearest(-99.0, 0.0, 0), 0.0);
            assert_eq!(nearest(0.0, 1.0, 0), 10.0);
            assert_eq!(nearest(0.0, 0.0, 2), 20.0);
            assert_eq!(nearest(f32::NAN, 0.0, 0), 0.0);
            assert_eq!(nearest(f32::INFINITY, 0.0, 0), 30.0);
            assert_eq!(nearest(f32::NEG_INFINITY, 0.0, 1), 10.0);
            assert_eq!(read(MipFilter::None, filter, 9.0, 0.0, 0), 0.0);
            let linear = |lod| read(MipFilter::Linear, filter, lod, 0.0, 0);
            assert!((linear(1.5) - 15.0).abs() < 1e-4);
            assert!((linear(0.25) - 2.5).abs() < 1e-4);
            assert!((linear(7.5) - 30.0).abs() < 1e-4);
        }
    }
}

#[test]
fn volumes_filter_along_three_axes() {
    let mut image = Image::new(TexelFormat::L8, TextureKind::Volume, [2, 2, 2], 1).unwrap();
    image.bytes_mut().copy_from_slice(&[0, 8, 16, 24, 32, 40, 48, 56]);
    let centre = sample(Some(&image), &linear(AddressMode::Clamp), &rules(Format::FP32), bits([0.5; 4]), Lod::Base);
    assert_eq!(f32::from_bits(centre[0]), 28.0 / 255.0);
    let state = SamplerState::NEAREST_CLAMP;
    let corner = sample(Some(&image), &state, &rules(Format::FP32), bits([0.9, 0.1, 0.9, 0.]), Lod::Base);
    assert_eq!(f32::from_bits(corner[0]), 40.0 / 255.0);
}

#[test]
fn border_and_unbound() {
    let image = Image::new_2d(TexelFormat::Bgrx8, 2, 2).unwrap();
    let state = SamplerState {
        address_u: AddressMode::Border,
        border: bits([1.0, 0.5, 2.0, 0.25]),
        ..SamplerState::NEAREST_CLAMP
    };
    let value = sample(Some(&image), &state, &rules(Format::FP32), bits([1.5, 0., 0., 0.]), Lod::Base);
    // Quantised to the texel's 8 bits and clamped; alpha is not stored.
    assert_eq!(value.map(f32::from_bits), [1.0, 128.0 / 255.0, 1.0, 1.0]);
    assert_eq!(sample(None, &state, &rules(Format::S3_12), [0; 4], Lod::Base), [0, 0, 0, 0x1000]);
    assert_eq!(unbound(Format::FP32), bits([0., 0., 0., 1.]));
}
