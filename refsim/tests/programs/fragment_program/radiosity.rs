//! The longest program that the card accepts: a block of 254 matrix texels times a vector, as in GPU radiosity of the
//! period: two reads, a multiply-add and a coordinate step per texel, 1024 instructions.

use super::nv35;
use crate::random::Random;
use refsim::asm::assemble;
use refsim::check::{RuleId, check};
use refsim::event::{FlowConstants, ProgramWork};
use refsim::exec::Constants;
use refsim::machine::{BoundTexture, DrawCall, ExecutorKind, Machine, VertexSource};
use refsim::raster::{PixelCenter, Primitive, Vertex};
use refsim::texture::{Image, SamplerState, TexelFormat, TextureKind};

const BLOCK: usize = 254;
const ROWS: u32 = 6;

/// Rows of the matrix are rows of texture 0; the vector is the single row of texture 1.
fn kernel(texels: usize) -> String {
    let mut text = "!!FP1.0\nMOVR R0, f[TEX0];\nMOVR R1, {0, 0, 0, 0};\n".to_owned();
    for _ in 0..texels {
        text += "TEX R2, R0, TEX0, RECT;\nTEX R3, R0, TEX1, RECT;\nMADR R1, R2, R3, R1;\nADDR R0.x, R0, {1}.x;\n";
    }
    text + "MOVR o[COLR], R1;\nEND\n"
}

/// Deterministic numbers between 0 and 1.
fn numbers(count: usize, seed: u64) -> Vec<f32> {
    let mut random = Random::new(seed);
    (0..count).map(|_| random.unit()).collect()
}

fn texture(width: u32, height: u32, values: &[f32]) -> Image {
    let mut image = Image::new(TexelFormat::Rgba32f, TextureKind::Rectangle, [width, height, 1], 1).unwrap();
    let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
    image.bytes_mut().copy_from_slice(&bytes);
    image
}

#[test]
fn a_block_is_as_long_as_the_instructions_allow() {
    let verdict = |texels| check(assemble(&kernel(texels)).unwrap(), &nv35());
    let program = verdict(BLOCK).unwrap();
    assert_eq!(program.instructions.len(), 4 * BLOCK + 3);
    // 255 texels need 1023 instructions, four per texel and three more; 256 texels need too many.
    verdict(BLOCK + 1).unwrap();
    let report = verdict(BLOCK + 2).unwrap_err();
    assert_eq!(report.violations.iter().map(|v| v.rule).collect::<Vec<_>>(), [RuleId::TooManyInstructions]);
    assert!(report.violations[0].message.contains("1027"), "{report}");
    let work = ProgramWork::new(&program, FlowConstants::default());
    assert_eq!((work.texture_slots(), work.arithmetic_slots()), (2 * BLOCK as u64, 2 * BLOCK as u64 + 3));
    assert_eq!(work.live_halves, 8, "R0 to R3");
    assert!(work.phases[0].textures.iter().all(|t| t.dependent));
}

#[test]
fn a_block_is_the_sum_that_a_loop_on_the_host_makes() {
    let program = check(assemble(&kernel(BLOCK)).unwrap(), &nv35()).unwrap();
    let matrix = numbers(4 * BLOCK * ROWS as usize, 1);
    let vector = numbers(4 * BLOCK, 2);
    let mut want = Vec::new();
    for row in matrix.chunks(4 * BLOCK) {
        let mut sum = [0.0_f32; 4];
        for (texel, x) in row.chunks(4).zip(vector.chunks(4)) {
            for c in 0..4 {
                sum[c] += texel[c] * x[c];
            }
        }
        want.extend(sum.iter().flat_map(|v| v.to_le_bytes()));
    }
    for kind in [ExecutorKind::Scalar, ExecutorKind::Batch] {
        let mut card = Machine::new(nv35(), kind);
        let target = card.create_target(TexelFormat::Rgba32f, 1, ROWS).unwrap();
        let textures = [texture(BLOCK as u32, ROWS, &matrix), texture(BLOCK as u32, 1, &vector)];
        let textures = textures.map(|image| card.create_texture(image).unwrap());
        let corner = |x: f32, y: f32| {
            let row = (y + 1.0) * 0.5 * ROWS as f32;
            let mut vertex = Vertex { position: [x, y, 0.0, 1.0].map(f32::to_bits), ..Vertex::default() };
            vertex.texcoords[0] = [0.5, row, 0.0, 1.0].map(f32::to_bits);
            vertex
        };
        let quad = [corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0), corner(-1.0, -1.0)];
        let constants = Constants::default();
        let source = VertexSource::Transformed(&quad);
        let mut call = DrawCall::new(source, Primitive::QuadList, &program, &constants, target);
        call.center = PixelCenter::OpenGl;
        call.clip_space = refsim::raster::ClipSpace::OpenGl;
        for (slot, texture) in call.samplers.iter_mut().zip(textures) {
            *slot = Some(BoundTexture { texture, state: SamplerState::NEAREST_CLAMP });
        }
        card.draw(&call).unwrap();
        assert_eq!(card.read_back(target).unwrap().bytes(), want, "{kind:?}");
    }
}
