//! Any bits in any state have a defined result and cause no panic.

use proptest::prelude::*;
use refsim::num::Format;
use refsim::texture::{
    AddressMode, Filter, Image, Lod, MipFilter, SampleRules, SamplerState, SignedTexelMinimum, TexelFormat,
    TextureKind, lod_from_derivatives, sample,
};

use crate::sampling::switched;

fn mode() -> impl Strategy<Value = AddressMode> {
    prop::sample::select(&super::addressing::MODES[..])
}

fn state() -> impl Strategy<Value = SamplerState> {
    let filter = || prop::sample::select(&[Filter::Nearest, Filter::Linear][..]);
    let mip = prop::sample::select(&[MipFilter::None, MipFilter::Nearest, MipFilter::Linear][..]);
    (filter(), filter(), mip, [mode(), mode(), mode()], any::<[u32; 4]>(), any::<u32>(), any::<u8>()).prop_map(
        |(min, mag, mip, [address_u, address_v, address_w], border, lod_bias, max_mip_level)| SamplerState {
            min,
            mag,
            mip,
            address_u,
            address_v,
            address_w,
            border,
            lod_bias,
            max_mip_level,
        },
    )
}

proptest! {
    #[test]
    fn any_bits_give_a_value_of_the_format(
        state in state(), coordinates in any::<[u32; 4]>(), lod in any::<u32>(),
        ddx in any::<[u32; 4]>(), ddy in any::<[u32; 4]>(),
        kind in 0usize..5, format in 0usize..TexelFormat::ALL.len(), to in 0usize..4,
        filter_fraction_bits in any::<u8>(), lod_fraction_bits in any::<u8>(), fill in any::<[u8; 16]>(),
        switches in 0u32..32,
    ) {
        let (kind, extents, levels) = [
            (TextureKind::D1, [9, 1, 1], 4),
            (TextureKind::D2, [5, 3, 1], 3),
            (TextureKind::Rectangle, [5, 3, 1], 1),
            (TextureKind::Cube, [4, 4, 1], 3),
            (TextureKind::Volume, [4, 2, 3], 2),
        ][kind];
        let mut image = Image::new(TexelFormat::ALL[format], kind, extents, levels).unwrap();
        image.bytes_mut().iter_mut().zip(fill.iter().cycle()).for_each(|(b, f)| *b = *f);
        let to = [Format::S3_12, Format::FP16, Format::FP24, Format::FP32][to];
        let minimum = SignedTexelMinimum::BelowMinusOne;
        let mut rules = SampleRules { filter_fraction_bits, lod_fraction_bits, signed_texel_minimum: minimum, ..SampleRules::exact(to) };
        (
            rules.filter_weight_rounding,
            rules.filter_arithmetic,
            rules.texel_values,
            rules.missing_channels,
            rules.border_storage,
        ) = switched(switches);
        let computed = lod_from_derivatives(&image, coordinates, ddx, ddy, lod_fraction_bits);
        prop_assert!(f32::from_bits(computed).is_finite());
        for lod in [Lod::Base, Lod::Level(lod), Lod::Level(computed)] {
            for value in sample(Some(&image), &state, &rules, coordinates, lod) {
                prop_assert_eq!(value & !to.mask(), 0);
                prop_assert!(!to.is_nan(value) || to.canonical_nan() == Some(value), "NaN {:#x} is not canonical", value);
            }
        }
    }
}
