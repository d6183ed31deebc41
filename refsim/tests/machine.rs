//! The emulated card from the outside: draws into targets, errors, threads.

use refsim::asm::assemble;
use refsim::device::Profile;
use refsim::exec::{CheckedProgram, Constants};
use refsim::machine::{DrawCall, ExecutorKind, Machine, VertexSource};
use refsim::num::Format;
use refsim::raster::{Primitive, Vertex};
use refsim::texture::{Image, SamplerState, TargetRounding, TexelFormat, TextureKind};

const ONE: u32 = 0x3f80_0000;

fn bits(v: [f32; 4]) -> [u32; 4] {
    v.map(f32::to_bits)
}

fn program(text: &str, _: &Profile) -> CheckedProgram {
    assemble(text).unwrap_or_else(|e| panic!("{e:?}"))
}

/// A quad over a whole target of `n` x `n` pixels, pixel centres at integers, with t0 running over texel centres.
fn screen(n: u32) -> Vec<Vertex> {
    let step = 1.0 / n as f32;
    let corner = |x: f32, y: f32, u: f32, v: f32| Vertex {
        position: bits([x - step, y + step, 0.5, 1.0]),
        texcoords: [bits([u, v, 0.0, 1.0]); 8],
        colors: [bits([0.25, 0.5, 0.75, 1.0]); 2],
        ..Vertex::default()
    };
    let (a, b) = (0.0, 1.0);
    vec![
        corner(-1.0, 1.0, a, a),
        corner(1.0, 1.0, b, a),
        corner(1.0, -1.0, b, b),
        corner(-1.0, -1.0, a, b),
    ]
}

fn gradient(n: u32) -> Image {
    let values: Vec<[u32; 4]> = (0..n * n)
        .map(|i| bits([(i % n) as f32 / 255.0, (i / n) as f32 / 255.0, 0.5, 1.0]))
        .collect();
    let format = TexelFormat::Rgba8;
    Image::from_values(format, TextureKind::D2, [n, n, 1], Format::FP32, &values, TargetRounding::Nearest).unwrap()
}

fn pixel(image: &Image, x: u32, y: u32) -> [u8; 4] {
    (image.raw(0, 0, y, x) as u32).to_le_bytes()
}

#[test]
fn ps_1_4_and_ps_2_0_copy_a_texture_through_a_full_screen_quad() {
    let texts = [
        ("r200", "ps_1_4\ntexld r0, t0"),
        ("r300", "ps_2_0\ndcl t0\ndcl_2d s0\ntexld r0, t0, s0\nmov oC0, r0"),
    ];
    for (device, text) in texts {
        let n = 40;
        let profile = Profile::named(device).unwrap();
        let program = program(text, &profile);
        let mut machine = Machine::new(profile, ExecutorKind::Scalar);
        let texture = machine.create_texture(gradient(n)).unwrap();
        let target = machine.create_target(TexelFormat::Bgra8, n, n).unwrap();
        let vertices = screen(n);
        let constants = Constants::default();
        let mut call = DrawCall::new(
            VertexSource::Transformed(&vertices),
            Primitive::QuadList,
            &program,
            &constants,
            target,
        )
        .with_texture(0, texture, SamplerState::NEAREST_CLAMP);
        // Texel centres: the quad's coordinates run from 0 to 1 over n pixels, half a texel on.
        for v in &mut call.samplers.iter_mut().flatten() {
            v.state.lod_bias = 0;
        }
        let events = machine.draw(&call).unwrap();
        assert_eq!(events.fragments.passed, u64::from(n * n), "{device}: every pixel once");
        assert_eq!(events.fragments.fetches[0], u64::from(n * n));
        let image = machine.read_back(target).unwrap();
        let [b, g, r, a] = pixel(image, 20, 30);
        // At the pixel centre u = 20/40 exactly or a rounding below: the texel is 20 or 19.
        assert!((19..=20).contains(&r) && (29..=30).contains(&g), "{device}: {r} {g}");
        assert_eq!((b, a), (128, 255), "{device}");
    }
    let _ = ONE;
}
