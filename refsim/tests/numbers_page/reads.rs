//! Tests of "Derivatives" and "Level of detail": lanes that form a derivative, and the grid of biased levels.

use super::running::{checked, ideal};
use super::{Random, probes};
use refsim::exec::scalar::PixelProgram;
use refsim::exec::{Constants, NoObserver, PixelBindings, SamplerBinding};
use refsim::num::Format;
use refsim::raster::FragmentInput;
use refsim::texture::{Filter, Image, MipFilter, SamplerState, TargetRounding, TexelFormat, TextureKind};

const SIZE: [u32; 2] = [64, 32];
/// Number of levels of the texture; each texel holds the number of its level.
const LEVELS: u32 = 7;

fn image() -> Image {
    let mut image = Image::new(TexelFormat::R32f, TextureKind::D2, [SIZE[0], SIZE[1], 1], LEVELS).unwrap();
    for (number, level) in image.levels().to_vec().into_iter().enumerate() {
        for (y, x) in (0..level.height).flat_map(|y| (0..level.width).map(move |x| (y, x))) {
            let value = [(number as f32).to_bits(); 4];
            image.store([number as u32, 0, y, x], Format::FP32, value, TargetRounding::Nearest).unwrap();
        }
    }
    image
}

/// Half the logarithm of a positive single, rounded to `bits` fraction bits, by repeated squaring.
fn half_logarithm(x: f32, bits: u32) -> f32 {
    match x {
        _ if x.is_nan() => return 0.0,
        0.0 => return -127.0,
        f32::INFINITY => return 127.0,
        _ => {}
    }
    let exact = f64::from(x).to_bits();
    let mut level = i64::from((exact >> 52) as i32 - 1023);
    let mut significand = u128::from(exact & ((1 << 52) - 1) | 1 << 52) << 10;
    for _ in 0..bits {
        significand = (significand * significand) >> 62;
        let carry = significand >> 63;
        level = 2 * level + i64::from(carry == 1);
        significand >>= carry;
    }
    (level.div_euclid(2)) as f32 / (1 << bits) as f32
}

/// Level of detail of a lane before biases.
fn level(t: &[[f32; 4]; 4], lane: usize, bits: u32) -> f32 {
    // Lanes: (0, 0), (1, 0), (0, 1), (1, 1).
    let (row, column) = (lane / 2, lane % 2);
    let along_x = [0, 1].map(|i| t[2 * row + 1][i] - t[2 * row][i]);
    let along_y = [0, 1].map(|i| t[2 + column][i] - t[column][i]);
    let squared = |d: [f32; 2]| {
        let [x, y] = [d[0] * SIZE[0] as f32, d[1] * SIZE[1] as f32];
        (x * x + y * y) + 0.0
    };
    let [a, b] = [squared(along_x), squared(along_y)];
    half_logarithm(if a.is_nan() || b.is_nan() { f32::NAN } else { a.max(b) }, bits)
}

fn on_grid(level: f32, bits: u32) -> f32 {
    let steps = (1 << bits) as f32;
    match level {
        _ if level.is_nan() => 0.0,
        _ => ((f64::from(level) * f64::from(steps)).floor() / f64::from(steps)).clamp(-128.0, 128.0) as f32,
    }
}

#[test]
fn levels_come_from_the_lanes_and_biases_of_the_page() {
    let mut r = Random::new(5);
    let image = image();
    let mut profile = ideal("fp32");
    let text = |read: &str| format!("ps_2_0\ndcl t0\ndcl_2d s0\n{read} r0, t0, s0\nmov oC0, r0");
    let programs = ["texld", "texldb"].map(|read| checked(&text(read), &profile));
    let host = Constants::default();
    for _ in 0..probes(3_000) {
        let bits = r.of(&[4, 5, 6, 8]);
        profile.rules.lod_fraction_bits = bits as u8;
        let scale = r.of(&[0.01, 0.1, 1.0, 10.0, 1e-30]);
        let lane = |r: &mut Random| [r.between(0.0, scale), r.between(0.0, scale), 0.0, r.between(-2.0, 2.0)];
        let mut t = [0; 4].map(|_| lane(&mut r));
        if r.below(20) == 0 {
            t[r.below(4)][r.below(2)] = r.single();
        }
        let sampler_bias = if r.below(3) == 0 { r.single() } else { r.between(-1.0, 1.0) };
        let mip = r.of(&[MipFilter::None, MipFilter::Nearest, MipFilter::Linear]);
        let state = SamplerState {
            min: Filter::Linear,
            mip,
            lod_bias: sampler_bias.to_bits(),
            max_mip_level: r.below(4),
            ..SamplerState::NEAREST_CLAMP
        };
        let mut bindings = PixelBindings::new(&host);
        bindings.samplers[0] = Some(SamplerBinding { image: &image, state });
        let biased = r.below(2);
        let inputs = t.map(|set| FragmentInput { t: [set.map(f32::to_bits); 8], ..FragmentInput::default() });
        let program = PixelProgram::new(&programs[biased], &profile.rules, &bindings);
        let found = program.run(&inputs, 0b1111, &mut [0; 16], &mut NoObserver).0;
        for (lane, result) in found.iter().enumerate() {
            let own = level(&t, lane, bits);
            let own = if biased == 1 { own + t[lane][3] } else { own };
            let wanted = on_grid(own + sampler_bias, bits);
            let (first, last) = (f32::from(state.max_mip_level), (LEVELS - 1) as f32);
            let expected = match mip {
                MipFilter::None => first,
                MipFilter::Nearest => (wanted + 0.5).floor().clamp(first, last),
                MipFilter::Linear => wanted.clamp(first, last),
            };
            assert_eq!(f32::from_bits(result.colors[0][0]), expected, "lane {lane} of {t:?}, {bits} bits, {state:?}");
        }
    }
}
