//! A shader drawn over a square of floats, its `@location(0)` going from (0, 0) in the first row to (1, 1).

use refsim::check::check;
use refsim::device::Profile;
use refsim::exec::Constants;
use refsim::front::translate_wgsl;
use refsim::machine::{DrawCall, Executor, ExecutorKind, VertexSource};
use refsim::raster::{PixelCenter, Primitive, full_screen_quad};
use refsim::texture::TexelFormat;

/// Pixels a side.
pub(crate) const SIDE: u32 = 16;

/// Uniforms by name.
pub(crate) type Uniforms<'a> = &'a [(&'a str, [f32; 4])];

/// Pixels, row by row.
pub(crate) fn drawn_by(executor: impl Into<Executor>, text: &str, uniforms: Uniforms<'_>) -> Vec<[f64; 4]> {
    let profile = Profile::named("ideal-fp32").expect("an ideal device");
    let program = translate_wgsl(text).unwrap_or_else(|refusal| panic!("{refusal:?}\n{text}"));
    let program = check(program, &profile).unwrap_or_else(|report| panic!("{report}\n{text}"));
    let mut card = executor.into().machine(profile).expect("a card");
    let target = card.create_target(TexelFormat::Rgba32f, SIDE, SIDE).expect("a target");
    let quad = full_screen_quad(|u, v| [[u, v, 0.0, 1.0]]);
    let mut constants = Constants::default();
    for (name, value) in uniforms {
        constants.named.insert((*name).to_owned(), value.map(f32::to_bits));
    }
    let vertices = VertexSource::Transformed(&quad);
    let mut call = DrawCall::new(vertices, Primitive::QuadList, &program, &constants, target);
    call.center = PixelCenter::OpenGl;
    card.draw(&call).expect("a draw");
    card.read_back(target).expect("the target").pixels().map(|pixel| pixel.rgba).collect()
}

/// Pixels, which both executors of the host draw alike.
pub(crate) fn drawn(text: &str, uniforms: Uniforms<'_>) -> Vec<[f64; 4]> {
    let [scalar, batch] = [ExecutorKind::Scalar, ExecutorKind::Batch].map(|kind| drawn_by(kind, text, uniforms));
    let bits = |pixels: &[[f64; 4]]| -> Vec<[u64; 4]> { pixels.iter().map(|pixel| pixel.map(f64::to_bits)).collect() };
    assert_eq!(bits(&scalar), bits(&batch), "{text}");
    scalar
}
