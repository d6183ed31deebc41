//! Properties of blending.

use proptest::prelude::*;
use refsim::num::Format;
use refsim::output::{BlendEquation, BlendFactor as F, BlendOp, BlendState, blend_texel};
use refsim::texture::{SignedTexelMinimum, TargetRounding, TexelFormat, decode, encode};

const NEAREST: TargetRounding = TargetRounding::Nearest;

fn target() -> impl Strategy<Value = TexelFormat> {
    use TexelFormat as T;
    prop::sample::select(
        &[
            T::Rgba8,
            T::Bgra8,
            T::Bgrx8,
            T::Bgr565,
            T::Bgra5551,
            T::L8,
            T::Rgb10a2,
            T::Rgba16,
            T::Rg16Snorm,
            T::Rgba16f,
            T::Rgba32f,
        ][..],
    )
}

/// A colour near 0 to 1 in some format.
fn color() -> impl Strategy<Value = (Format, [u32; 4])> {
    prop_oneof![
        [0u32..=0x1200, 0u32..=0x1200, 0u32..=0x1200, 0u32..=0x1200].prop_map(|c| (Format::S3_12, c)),
        [-0.2f32..1.2, -0.2f32..1.2, -0.2f32..1.2, 0.0f32..1.2].prop_map(|c| (Format::FP32, c.map(f32::to_bits))),
    ]
}

/// A texel of the target with values from 0 to 1.
fn texel(format: TexelFormat, values: [f32; 4]) -> u128 {
    encode(format, Format::FP32, values.map(f32::to_bits), NEAREST)
}

proptest! {
    #[test]
    fn identities(format in target(), (from, source) in color(), old in [0.0f32..1.0, 0.0f32..1.0, 0.0f32..1.0, 0.0f32..1.0]) {
        let old = texel(format, old);
        let plain = encode(format, from, source, NEAREST);
        let blend = |s, d, op| blend_texel(format, old, from, source, &BlendState::both(s, d, op), NEAREST);
        prop_assert_eq!(blend(F::One, F::Zero, BlendOp::Add), plain);
        prop_assert_eq!(blend(F::Zero, F::One, BlendOp::Add), old);
        prop_assert_eq!(blend(F::One, F::Zero, BlendOp::Subtract), plain);
        prop_assert_eq!(blend(F::Zero, F::One, BlendOp::ReverseSubtract), old);
        prop_assert_eq!(blend(F::Zero, F::Zero, BlendOp::Add), texel(format, [0.0; 4]));
        // Modulation is symmetric.
        prop_assert_eq!(blend(F::DestColor, F::Zero, BlendOp::Add), blend(F::Zero, F::SrcColor, BlendOp::Add));
        // Minimum and maximum select one of the two.
        let with = |op| blend_texel(format, old, Format::FP32, decode(format, old, SignedTexelMinimum::Clamp).to_format(Format::FP32), &BlendState::both(F::Zero, F::Zero, op), NEAREST);
        prop_assert_eq!((with(BlendOp::Min), with(BlendOp::Max)), (old, old));
    }

    /// Alpha 1 gives the source, alpha 0 the destination; modulation with white changes nothing.
    #[test]
    fn alpha_ends(format in target(), (from, mut source) in color(), old in [0.0f32..1.0, 0.0f32..1.0, 0.0f32..1.0, 0.0f32..1.0]) {
        let old = texel(format, old);
        let over = BlendState::both(F::SrcAlpha, F::InvSrcAlpha, BlendOp::Add);
        source[3] = from.one();
        let plain = encode(format, from, source, NEAREST);
        let value = |raw| decode(format, raw, SignedTexelMinimum::Clamp).to_format(Format::FP32).map(|b| f32::from_bits(b) + 0.0);
        prop_assert_eq!(value(blend_texel(format, old, from, source, &over, NEAREST)), value(plain));
        source[3] = 0;
        prop_assert_eq!(value(blend_texel(format, old, from, source, &over, NEAREST)), value(old));
        let white = [from.one(); 4];
        let modulate = BlendState::both(F::DestColor, F::Zero, BlendOp::Add);
        prop_assert_eq!(value(blend_texel(format, old, from, white, &modulate, NEAREST)), value(old));
    }

    /// Every factor and operation compared with its formula in f64, within one 8-bit code.
    #[test]
    fn formulas(s in 0usize..11, d in 0usize..11, op in 0usize..5, source in [0u8.., 0u8.., 0u8.., 0u8..], old in [0u8.., 0u8.., 0u8.., 0u8..]) {
        let (s, d) = (F::ALL[s], F::ALL[d]);
        let op = [BlendOp::Add, BlendOp::Subtract, BlendOp::ReverseSubtract, BlendOp::Min, BlendOp::Max][op];
        let source_values = decode(TexelFormat::Rgba8, u128::from(u32::from_le_bytes(source)), SignedTexelMinimum::Clamp).to_format(Format::FP32);
        let found = blend_texel(TexelFormat::Rgba8, u128::from(u32::from_le_bytes(old)), Format::FP32, source_values, &BlendState::both(s, d, op), NEAREST);
        let (sv, dv) = (source.map(|k| f64::from(k) / 255.0), old.map(|k| f64::from(k) / 255.0));
        for i in 0..4 {
            let factor = |f: F| match f {
                F::Zero => 0.0,
                F::One => 1.0,
                F::SrcColor => sv[i],
                F::InvSrcColor => 1.0 - sv[i],
                F::SrcAlpha => sv[3],
                F::InvSrcAlpha => 1.0 - sv[3],
                F::DestAlpha => dv[3],
                F::InvDestAlpha => 1.0 - dv[3],
                F::DestColor => dv[i],
                F::InvDestColor => 1.0 - dv[i],
                F::SrcAlphaSat => if i == 3 { 1.0 } else { sv[3].min(1.0 - dv[3]) },
            };
            let (a, b) = (sv[i] * factor(s), dv[i] * factor(d));
            let want = match op {
                BlendOp::Add => a + b,
                BlendOp::Subtract => a - b,
                BlendOp::ReverseSubtract => b - a,
                BlendOp::Min => sv[i].min(dv[i]),
                BlendOp::Max => sv[i].max(dv[i]),
            };
            let want = want.clamp(0.0, 1.0) * 255.0;
            let code = (found >> (8 * i) & 255) as f64;
            prop_assert!((code - want).abs() <= 0.5 + 1e-9, "{:?} {:?} {:?}: {} for {}", s, d, op, code, want);
        }
    }

    #[test]
    fn any_bits_blend(format in 0usize..TexelFormat::ALL.len(), old in any::<u128>(), source in any::<[u32; 4]>(), s in 0usize..11, d in 0usize..11, op in 0usize..5) {
        let op = [BlendOp::Add, BlendOp::Subtract, BlendOp::ReverseSubtract, BlendOp::Min, BlendOp::Max][op];
        let format = TexelFormat::ALL[format];
        let equation = BlendEquation { source: F::ALL[s], destination: F::ALL[d], op };
        let state = BlendState { color: equation, alpha: BlendEquation { source: F::ALL[d], ..equation } };
        let size = 8 * format.bytes() as u32;
        for rounding in [NEAREST, TargetRounding::Truncate] {
            let new = blend_texel(format, old, Format::FP32, source, &state, rounding);
            prop_assert!(size == 128 || new >> size == 0);
        }
    }
}
