//! Tests of the section "Vertex colors": the clamp before interpolation, on both executors of the host.

use super::running::checked;
use super::{Random, clean, probes};
use refsim::device::{ColorClamp, Profile};
use refsim::exec::Constants;
use refsim::machine::{AttributeStream, DrawCall, ExecutorKind, Machine, StepRate, VertexSource, VertexStreams};
use refsim::raster::{Primitive, Vertex};
use refsim::texture::TexelFormat;

/// A color before interpolation, as the page states it; `None` if it is unchanged.
fn clamped(clamp: ColorClamp, by_program: bool, x: f32) -> Option<f32> {
    let range = if x > 1.0 { 1.0 } else { x.max(0.0) };
    match clamp {
        ColorClamp::Vertex if x.is_nan() => Some(if x.is_sign_negative() { 0.0 } else { 1.0 }),
        ColorClamp::Vertex => Some(range),
        ColorClamp::Program if by_program => Some(if x.is_nan() { 0.0 } else { range }),
        ColorClamp::Program | ColorClamp::Pixel => None,
    }
}

/// The color at the pixel's center, compared to within one 8-bit code.
#[test]
fn vertex_colors_are_clamped_where_the_page_says() {
    let mut r = Random::new(31);
    let place = [[-1.0f32, 1.0], [7.0, 1.0], [-1.0, -7.0]].map(|[x, y]| [x, y, 0.5, 1.0].map(f32::to_bits));
    for &clamp in ColorClamp::ALL {
        let mut profile = Profile::named("ideal-fp32").expect("a device");
        profile.rules.color_clamp = clamp;
        let pixel = checked("ps_1_4\nmov r0, v0", &profile);
        let vertex = checked("vs_1_1\ndcl_position v0\ndcl_color v1\nmov oPos, v0\nmov oD0, v1", &profile);
        let host = Constants::default();
        for _ in 0..probes(60) {
            let (constant, by_program) = (r.coin(), r.coin());
            let first = clean(r.single());
            let colors = [(); 3].map(|()| if constant { first } else { clean(r.between(-3.0, 3.0)) });
            let values = colors.map(|bits| {
                let x = f32::from_bits(bits);
                clamped(clamp, by_program, x).unwrap_or(x)
            });
            // Pixel (0, 0) of four by four: its center is within half a pixel of the first corner.
            let bits: Vec<[u32; 4]> = colors.map(|color| [color; 4]).to_vec();
            let corners = [0, 1, 2].map(|i| Vertex { position: place[i], colors: [bits[i]; 2], ..Vertex::default() });
            let stream = |register, data| AttributeStream { register, step: StepRate::Vertex, data };
            let streams = vec![stream(0, &place[..]), stream(1, &bits[..])];
            let source = match by_program {
                true => VertexSource::Program {
                    program: &vertex,
                    constants: &host,
                    streams: VertexStreams { vertex_count: 3, instance_count: 1, streams },
                },
                false => VertexSource::Transformed(&corners),
            };
            for kind in [ExecutorKind::Scalar, ExecutorKind::Batch] {
                let mut machine = Machine::new(profile.clone(), kind);
                let target = machine.create_target(TexelFormat::Rgba32f, 4, 4).expect("a target");
                let call = DrawCall::new(source.clone(), Primitive::TriangleList, &pixel, &host, target);
                machine.draw(&call).expect("drawn");
                let at =
                    |x: u32, y: u32| f32::from_bits(machine.read_back(target).expect("read").raw(0, 0, y, x) as u32);
                // The first corner is the center of pixel (0, 0) in Direct3D; a pixel to the right is a quarter of the
                // way to the second.
                let blend = |t: f32| {
                    let [a, b, _] = values;
                    let mixed = if constant { a } else { a + t * (b - a) };
                    if mixed.is_nan() { 0.0 } else { mixed.clamp(0.0, 1.0) }
                };
                for (x, t) in [(0, 0.0), (1, 0.0625), (3, 0.1875)] {
                    let what = format!("{clamp:?}, by a program: {by_program}, {values:?}, {kind:?}");
                    assert!((at(x, 0) - blend(t)).abs() <= 1e-6, "{what}: {} for {}", at(x, 0), blend(t));
                }
            }
        }
    }
}
