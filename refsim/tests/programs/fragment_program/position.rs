//! `f[WPOS]` and `fragment.position`: column and row of the pixel's center, depth, 1 / w.

use crate::running::{quads, run_quad};
use refsim::asm::assemble;
use refsim::check::check;
use refsim::device::Profile;
use refsim::exec::{Constants, PixelBindings};
use refsim::machine::{DrawCall, ExecutorKind, Machine};
use refsim::raster::{ClipSpace, FragmentInput, PixelCenter, Vertex};
use refsim::texture::TexelFormat;

const WIDTH: u32 = 20;
const HEIGHT: u32 = 6;

/// Draws a quad over a target and returns the colors. The quad's left corners have the first w and depth, the right
/// corners the second.
fn drawn(kind: ExecutorKind, text: &str, center: PixelCenter, w: [f32; 2], depth: [f32; 2]) -> Vec<[f32; 4]> {
    let profile = Profile::named("nv35").unwrap();
    let program = check(assemble(text).unwrap(), &profile).unwrap();
    let mut card = Machine::new(profile, kind);
    let target = card.create_target(TexelFormat::Rgba32f, WIDTH, HEIGHT).unwrap();
    let quad = [(-1.0, 1.0), (1.0, 1.0), (1.0, -1.0), (-1.0, -1.0_f32)].map(|(x, y)| {
        let right = usize::from(x > 0.0);
        // Depth is (z / w + 1) / 2.
        let texcoords = [[0.5, -3.0, 7.0, 1.0].map(f32::to_bits); 8];
        let position = [x, y, 2.0 * depth[right] - 1.0, 1.0].map(|c: f32| (c * w[right]).to_bits());
        Vertex { position, texcoords, ..Vertex::default() }
    });
    let constants = Constants::default();
    let call = quads(&quad, &program, &constants, target);
    card.draw(&DrawCall { center, clip_space: ClipSpace::OpenGl, ..call }).unwrap();
    let image = card.read_back(target).unwrap();
    let word = |bytes: &[u8]| f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
    image.bytes().chunks_exact(16).map(|texel| [0, 4, 8, 12].map(|at| word(&texel[at..]))).collect()
}

const NV: &str = "!!FP1.0\nMOVR o[COLR], f[WPOS];\nEND";
const ARB: &str = "!!ARBfp1.0\nATTRIB p = fragment.position;\nMOV result.color, p;\nEND";

fn at(texels: &[[f32; 4]], x: u32, y: u32) -> [f32; 4] {
    texels[(y * WIDTH + x) as usize]
}

#[test]
fn the_window_position_is_the_centre_of_the_pixel_the_depth_and_the_reciprocal_of_w() {
    for (center, offset) in [(PixelCenter::OpenGl, 0.5), (PixelCenter::Direct3d, 0.0)] {
        for text in [NV, ARB] {
            let texels = drawn(ExecutorKind::Scalar, text, center, [2.0; 2], [0.25; 2]);
            for (x, y) in [(1, 0), (1, 1), (17, 4), (16, 3)] {
                assert_eq!(at(&texels, x, y), [x as f32 + offset, y as f32 + offset, 0.25, 0.5], "{text}");
            }
        }
    }
}

#[test]
fn depth_and_the_reciprocal_of_w_are_linear_along_the_screen() {
    let texels = drawn(ExecutorKind::Scalar, NV, PixelCenter::OpenGl, [1.0, 4.0], [0.0, 1.0]);
    for x in 0..WIDTH {
        let share = (f64::from(x) + 0.5) / f64::from(WIDTH);
        let [.., depth, w] = at(&texels, x, 3).map(f64::from);
        assert!((depth - share).abs() < 1e-6, "{x}: depth {depth}");
        assert!((w - (1.0 - 0.75 * share)).abs() < 1e-6, "{x}: 1 / w {w}");
    }
}

#[test]
fn differences_of_what_is_constant_are_zero_on_every_executor() {
    for text in [
        "!!FP1.0\nDDXR R0.xy, f[TEX0];\nDDYR R0.zw, f[TEX0];\nMOVR o[COLR], R0;\nEND",
        "ps_2_a\ndcl t0\ndsx r0, t0\ndsy r1, t0\nmov r0.zw, r1\nmov oC0, r0",
    ] {
        for kind in [ExecutorKind::Scalar, ExecutorKind::Batch] {
            let texels = drawn(kind, text, PixelCenter::OpenGl, [1.0; 2], [0.5; 2]);
            assert!(texels.iter().all(|texel| *texel == [0.0; 4]), "{kind:?}: {texels:?}\n{text}");
        }
    }
}

#[test]
fn the_position_enters_the_format_of_the_registers() {
    let half = Profile::named("ideal-e5m10").unwrap();
    // 2049.5 is not representable in fp16, whose spacing is 2 there.
    let position = [2049.5_f32, 0.5, 0.1, 1.0].map(f32::to_bits);
    let input = FragmentInput { position, ..FragmentInput::default() };
    let host = Constants::default();
    let ran = run_quad(NV, &half, &PixelBindings::new(&host), &[input; 4]);
    assert_eq!(ran.results[0].colors[0], [0x6801, 0x3800, 0x2e66, 0x3c00]);
}
