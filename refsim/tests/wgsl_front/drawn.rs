//! Draws a shader over a square float target; its `@location(0)` goes from (0, 0) in the first row to (1, 1).

use std::collections::BTreeMap;

use refsim::check::check;
use refsim::device::Profile;
use refsim::exec::Constants;
use refsim::front::translate_wgsl;
use refsim::isa::Program;
use refsim::machine::{DrawCall, Executor, ExecutorKind, VertexSource};
use refsim::num::Format;
use refsim::raster::{PixelCenter, Primitive, full_screen_quad};
use refsim::texture::{Image, SamplerState, TargetRounding, TexelFormat, TextureKind};

/// Width and height of the target, in pixels, and of the texture in slot 0, in texels.
pub(crate) const SIDE: u32 = 16;

pub(crate) type Uniforms<'a> = &'a [(&'a str, [f32; 4])];

#[derive(Clone, Copy)]
pub(crate) struct Inputs<'a> {
    pub(crate) uniforms: Uniforms<'a>,
    /// Texels of slot 0, row by row; the nearest one is read.
    pub(crate) texels: &'a [[f32; 4]],
    /// Selects the instructions that compute in a float with 5 exponent and 10 fraction bits.
    pub(crate) half: &'a dyn Fn(&Program) -> Vec<usize>,
}

/// Random numbers in [0, 1) with `bits` bits.
pub(crate) fn draw(seed: u32, bits: u32) -> impl FnMut() -> f32 {
    let mut state = u64::from(seed) << 32 | 0x9e37_79b9;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> (64 - bits)) as f32 / (1_u64 << bits) as f32
    }
}

/// Texels computed by `of` from four random numbers in [0, 1) each.
pub(crate) fn texels(seed: u32, bits: u32, of: impl Fn([f32; 4]) -> [f32; 4]) -> Vec<[f32; 4]> {
    let mut number = draw(seed, bits);
    (0..SIDE * SIDE).map(|_| of([(); 4].map(|()| number()))).collect()
}

/// Pixels, row by row.
pub(crate) fn drawn_with(executor: impl Into<Executor>, text: &str, inputs: &Inputs<'_>) -> Vec<[f64; 4]> {
    let mut profile = Profile::named("ideal-fp32").expect("an ideal device");
    let program = translate_wgsl(text).unwrap_or_else(|refusal| panic!("{refusal:?}\n{text}"));
    let half = Format { kind: Format::FP16.kind, ..Format::FP32 };
    let formats: BTreeMap<usize, Format> = (inputs.half)(&program).into_iter().map(|at| (at, half)).collect();
    assert!(profile.set_instruction_formats(&program, formats), "{text}");
    let program = check(program, &profile).unwrap_or_else(|report| panic!("{report}\n{text}"));
    let mut card = executor.into().machine(profile).expect("a card");
    let target = card.create_target(TexelFormat::Rgba32f, SIDE, SIDE).expect("a target");
    let values: Vec<[u32; 4]> = inputs.texels.iter().map(|texel| texel.map(f32::to_bits)).collect();
    let (format, extents) = (TexelFormat::Rgba32f, [SIDE, SIDE, 1]);
    let nearest = TargetRounding::Nearest;
    let image = Image::from_values(format, TextureKind::D2, extents, Format::FP32, &values, nearest);
    let texture = card.create_texture(image.expect("an image")).expect("a texture");
    let quad = full_screen_quad(|u, v| [[u, v, 0.0, 1.0]]);
    let mut constants = Constants::default();
    for (name, value) in inputs.uniforms {
        constants.named.insert((*name).to_owned(), value.map(f32::to_bits));
    }
    let vertices = VertexSource::Transformed(&quad);
    let call = DrawCall::new(vertices, Primitive::QuadList, &program, &constants, target);
    let mut call = call.with_texture(0, texture, SamplerState::default());
    call.center = PixelCenter::OpenGl;
    card.draw(&call).expect("a draw");
    card.read_back(target).expect("the target").pixels().map(|pixel| pixel.rgba).collect()
}

/// The pixels; asserts that both executors of the host draw the same ones.
pub(crate) fn drawn_of(text: &str, inputs: &Inputs<'_>) -> Vec<[f64; 4]> {
    let [scalar, batch] = [ExecutorKind::Scalar, ExecutorKind::Batch].map(|kind| drawn_with(kind, text, inputs));
    let bits = |pixels: &[[f64; 4]]| -> Vec<[u64; 4]> { pixels.iter().map(|pixel| pixel.map(f64::to_bits)).collect() };
    assert_eq!(bits(&scalar), bits(&batch), "{text}");
    scalar
}

/// Same as [`drawn_of`], with random texels from 0 to 1.
pub(crate) fn drawn(text: &str, uniforms: Uniforms<'_>) -> Vec<[f64; 4]> {
    drawn_of(text, &Inputs { uniforms, texels: &texels(0, 24, |texel| texel), half: &|_| Vec::new() })
}
