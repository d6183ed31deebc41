//! Generated mip levels compared with exact fractions, texel by texel.

use super::rational::Rational;
use crate::random::Random;
use num_bigint::BigInt;
use proptest::prelude::*;
use refsim::num::Format;
use refsim::texture::{
    ChannelClass, ChannelValue, Filter, Image, Lod, MipFilter, MipmapRules, SampleRules, SamplerState,
    SignedTexelMinimum, TargetRounding, TexelFormat, TextureKind, decode_channel, sample,
};

const KINDS: [TextureKind; 4] = [TextureKind::D1, TextureKind::D2, TextureKind::Cube, TextureKind::Volume];

/// An image with all its levels, filled with random bytes.
fn noise(format: TexelFormat, kind: TextureKind, [w, h, d]: [u32; 3], seed: u64) -> Image {
    let extents = match kind {
        TextureKind::D1 => [w, 1, 1],
        TextureKind::Cube => [w, w, 1],
        TextureKind::Volume => [w, h, d],
        _ => [w, h, 1],
    };
    let mut image = Image::new(format, kind, extents, Image::most_levels(kind, extents)).unwrap();
    let mut random = Random::new(seed);
    image.bytes_mut().fill_with(|| random.code());
    image
}

/// Texel positions in the finer level that are averaged into texel `place` of the coarser level.
fn under(finer: [u32; 3], coarser: [u32; 3], place: [u32; 3]) -> Vec<[u32; 3]> {
    let mut places = vec![place];
    for axis in 0..3 {
        if finer[axis] == coarser[axis] {
            continue;
        }
        let twice = |second: u32| {
            places
                .iter()
                .map(move |&p| {
                    let mut p = p;
                    p[axis] = 2 * p[axis] + second;
                    p
                })
                .collect::<Vec<_>>()
        };
        places = [twice(0), twice(1)].concat();
    }
    places
}

/// Asserts that every texel of every level is the mean of the previous level's texels, rounded by value.
fn check(image: &Image, rules: MipmapRules) {
    let mut filled = image.clone();
    filled.generate_mipmaps(rules);
    let level_0 = image.level_bytes(0);
    assert_eq!(filled.level_bytes(0), level_0, "level 0 is as it was");
    for level in 1..filled.levels().len() {
        let [finer, coarser] = [level - 1, level].map(|l| filled.levels()[l]);
        let extents = |l: refsim::texture::Level| [l.width, l.height, l.slices];
        for slice in 0..coarser.slices {
            for y in 0..coarser.height {
                for x in 0..coarser.width {
                    let places = under(extents(finer), extents(coarser), [x, y, slice]);
                    let raw = filled.raw(level as u32, slice, y, x);
                    let taps: Vec<u128> =
                        places.iter().map(|&[x, y, slice]| filled.raw(level as u32 - 1, slice, y, x)).collect();
                    check_texel(image.format(), raw, &taps, rules, &format!("level {level} at {slice}, {y}, {x}"));
                }
            }
        }
    }
}

fn check_texel(format: TexelFormat, raw: u128, taps: &[u128], rules: MipmapRules, place: &str) {
    let mut unused = raw;
    for &channel in format.record().stored() {
        let mask = u128::from(u32::MAX >> (32 - channel.bits));
        let bits = |raw: u128| (raw >> channel.shift & mask) as u32;
        unused &= !(mask << channel.shift);
        let value = |raw: u128| match decode_channel(channel, bits(raw), rules.signed_texel_minimum) {
            ChannelValue::Ratio { numerator, denominator } => Rational::new(numerator, denominator),
            ChannelValue::Float { .. } => panic!("{format} is no fraction"),
        };
        let sum = taps.iter().fold(Rational::new(0, 1), |sum, &tap| sum.add(&value(tap)));
        let mean = sum.mul(&Rational::new(1, taps.len() as u64));
        let negative = mean.n < BigInt::from(0);
        let steps: i64 = match channel.class {
            ChannelClass::Unorm => (1 << channel.bits) - 1,
            ChannelClass::Snorm => (1 << (channel.bits - 1)) - 1,
            _ if negative => 16,
            _ => 15,
        };
        let size = if negative { -mean.n } else { mean.n } * steps;
        let half = if rules.rounding == TargetRounding::Nearest { mean.d.clone() } else { BigInt::from(0) };
        let code = i64::try_from((size * 2 + half) / (mean.d * 2)).unwrap().min(steps);
        let expected = if negative { -code } else { code } as u32 & mask as u32;
        assert_eq!(bits(raw), expected, "{format} {place}: {taps:x?}");
    }
    assert_eq!(unused, 0, "{format} {place}: bits of no channel");
}

proptest! {
    #[test]
    fn a_texel_is_the_mean_of_those_under_it(
        extents in [1_u32..10, 1_u32..10, 1_u32..6], kind in 0..KINDS.len(), seed in any::<u64>(),
        nearest in any::<bool>(), clamp in any::<bool>(),
    ) {
        let rounding = if nearest { TargetRounding::Nearest } else { TargetRounding::Truncate };
        let minimum = if clamp { SignedTexelMinimum::Clamp } else { SignedTexelMinimum::BelowMinusOne };
        let rules = MipmapRules { rounding, signed_texel_minimum: minimum };
        let fractions: Vec<TexelFormat> = TexelFormat::ALL.iter().copied().filter(|f| !f.record().is_float()).collect();
        let format = fractions[(seed >> 7) as usize % fractions.len()];
        check(&noise(format, KINDS[kind], extents, seed), rules);
    }
}

#[test]
fn every_format_and_long_thin_images() {
    for rounding in [TargetRounding::Nearest, TargetRounding::Truncate] {
        let rules = MipmapRules { rounding, signed_texel_minimum: SignedTexelMinimum::Clamp };
        for (seed, &format) in (0..).zip(TexelFormat::ALL.iter().filter(|f| !f.record().is_float())) {
            check(&noise(format, TextureKind::D2, [16, 8, 1], seed), rules);
            check(&noise(format, TextureKind::D2, [1, 37, 1], seed), rules);
            check(&noise(format, TextureKind::D2, [37, 1, 1], seed), rules);
            check(&noise(format, TextureKind::D2, [1, 1, 1], seed), rules);
        }
    }
}

#[test]
fn float_levels_are_linear_reads() {
    let minimum = SignedTexelMinimum::Clamp;
    let rules = MipmapRules { rounding: TargetRounding::Truncate, signed_texel_minimum: minimum };
    let reads = SampleRules::exact(Format::FP32);
    let linear = SamplerState {
        min: Filter::Linear,
        mag: Filter::Linear,
        mip: MipFilter::Nearest,
        ..SamplerState::NEAREST_CLAMP
    };
    for (seed, &format) in (0..).zip(TexelFormat::ALL.iter().filter(|f| f.record().is_float())) {
        for size in [[8, 8], [16, 4], [1, 16], [16, 1]] {
            let mut image = noise(format, TextureKind::D2, [size[0], size[1], 1], seed);
            image.generate_mipmaps(rules);
            for level in 1..image.levels().len() as u32 {
                let l = image.levels()[level as usize];
                for (y, x) in (0..l.height).flat_map(|y| (0..l.width).map(move |x| (y, x))) {
                    let middle = |i: u32, extent: u32| ((i as f32 + 0.5) / extent as f32).to_bits();
                    let place = [middle(x, l.width), middle(y, l.height), 0, 0];
                    let read = sample(Some(&image), &linear, &reads, place, Lod::Level((level as f32 - 1.0).to_bits()));
                    let mut stored = Image::new_2d(format, 1, 1).unwrap();
                    stored.store([0; 4], Format::FP32, read, TargetRounding::Nearest).unwrap();
                    assert_eq!(
                        image.raw(level, 0, y, x),
                        stored.raw(0, 0, 0, 0),
                        "{format} {size:?}, level {level} at {y}, {x}"
                    );
                }
            }
        }
    }
}

#[test]
fn levels_are_kept_or_empty() {
    let image = noise(TexelFormat::Bgr565, TextureKind::D2, [6, 4, 1], 5);
    let one = image.with_levels(1).unwrap();
    assert_eq!((one.levels().len(), one.bytes()), (1, image.level_bytes(0)));
    let again = one.with_levels(3).unwrap();
    assert_eq!(again.level_bytes(0), image.level_bytes(0));
    assert!(again.level_bytes(1).iter().chain(again.level_bytes(2)).all(|&b| b == 0));
    assert!(again.level_bytes(3).is_empty() && one.with_levels(4).is_err());
    let cube = noise(TexelFormat::L8, TextureKind::Cube, [4, 4, 1], 9);
    assert_eq!(cube.with_levels(3).unwrap(), cube);
}
