//! Tests targets with a single row of quads, for which the batch executor uses flat tiles, and textures that are too
//! large for its tables, against the scalar executor's bits and counts.

use crate::random::Random;
use refsim::asm::assemble;
use refsim::check::check;
use refsim::device::Profile;
use refsim::event::DrawEvents;
use refsim::exec::Constants;
use refsim::machine::{DrawCall, ExecutorKind, Machine, VertexSource};
use refsim::num::Format;
use refsim::output::{BlendFactor, BlendOp, BlendState, CompareFunction, DepthFormat, DepthState};
use refsim::raster::{PixelCenter, Primitive, Vertex};
use refsim::texture::{AddressMode, Image, Region, SamplerState, TargetRounding, TexelFormat, TextureKind};

/// A program that takes differences, reads its position, and reads texture 0.
const PROGRAM: &str = "!!FP1.0
TEX R0, f[TEX0], TEX0, 2D;
DDX R1, f[TEX1];
DDY R2, f[TEX1];
MADR R0, R1, R2, R0;
MADR R0.xy, f[WPOS], {0.001}.x, R0;
MOVR o[COLR], R0;
END";

/// A program without differences, so that tiles may have a single row; kills some fragments.
const APART: &str = "!!FP1.0
TEX R0, f[TEX0], TEX0, 2D;
SLTRC RC.x, R0, {0.3}.x;
KIL GT.x;
MADR R0.xy, f[WPOS], {0.001}.x, R0;
MADR R0, f[TEX1], R0.yzwx, R0;
MOVR o[COLR], R0;
END";

/// Parameters of a draw.
struct Case {
    size: [u32; 2],
    scissor: Option<Region>,
    texture: Image,
    state: SamplerState,
    target: TexelFormat,
}

fn image(format: TexelFormat, side: u32, random: &mut Random) -> Image {
    let values: Vec<[u32; 4]> = (0..side * side).map(|_| [(); 4].map(|()| random.unit().to_bits())).collect();
    let (kind, extents) = (TextureKind::D2, [side, side, 1]);
    Image::from_values(format, kind, extents, Format::FP32, &values, TargetRounding::Nearest).unwrap()
}

fn triangles(count: usize, random: &mut Random) -> Vec<Vertex> {
    let vertex = |random: &mut Random| {
        let mut spread = |by: f32| random.between(-by, by);
        let position = [spread(1.5), spread(2.5), 0.5 + spread(0.4), 1.0 + spread(0.3)].map(f32::to_bits);
        let mut vertex = Vertex { position, ..Vertex::default() };
        for set in &mut vertex.texcoords[..2] {
            *set = [spread(1.5), spread(1.5), spread(1.0), 1.0].map(f32::to_bits);
        }
        vertex
    };
    (0..3 * count).map(|_| vertex(random)).collect()
}

fn draw(case: &Case, program: &str, vertices: &[Vertex], mut machine: Machine) -> (Vec<u8>, Vec<u32>, DrawEvents) {
    let program = check(assemble(program).unwrap(), machine.profile()).unwrap();
    let [width, height] = case.size;
    let target = machine.create_target(case.target, width, height).unwrap();
    let depth = machine.create_depth(DepthFormat::Unorm24, width, height).unwrap();
    let texture = machine.create_texture(case.texture.clone()).unwrap();
    let constants = Constants::default();
    let source = VertexSource::Transformed(vertices);
    let mut call = DrawCall::new(source, Primitive::TriangleList, &program, &constants, target)
        .with_texture(0, texture, case.state);
    call.center = PixelCenter::OpenGl;
    call.scissor = case.scissor;
    call.depth = DepthState { test: Some(CompareFunction::LessEqual), write: true };
    call.depth_buffer = Some(depth);
    if case.target == TexelFormat::Bgra8 {
        call.blend = Some(BlendState::both(BlendFactor::One, BlendFactor::One, BlendOp::Add));
    }
    let events = machine.draw(&call).unwrap();
    let depths = machine.read_depth(depth).unwrap().data().to_vec();
    (machine.read_back(target).unwrap().bytes().to_vec(), depths, events)
}

fn agrees(case: &Case, vertices: &[Vertex]) {
    [PROGRAM, APART].into_iter().for_each(|program| agrees_in(case, program, vertices));
}

fn agrees_in(case: &Case, program: &str, vertices: &[Vertex]) {
    let nv35 = Profile::named("nv35").unwrap();
    let expected = draw(case, program, vertices, Machine::new(nv35.clone(), ExecutorKind::Scalar));
    for threads in [1, 3] {
        let machine = Machine::with_threads(nv35.clone(), ExecutorKind::Batch, threads).unwrap();
        let found = draw(case, program, vertices, machine);
        let what = format!("{:?}, scissor {:?}, {threads} threads", case.size, case.scissor);
        assert_eq!(found.2, expected.2, "{what}: counts");
        let differing = found.0.iter().zip(&expected.0).position(|(a, b)| a != b);
        assert_eq!(differing, None, "{what}: the first byte that differs");
        assert!(found.1 == expected.1, "{what}: depths");
    }
    assert!(expected.2.fragments.generated > 0, "something is drawn");
}

#[test]
fn targets_of_one_row_of_quads_are_drawn_alike() {
    let mut random = Random::new(1);
    let texture = image(TexelFormat::Rgba32f, 20, &mut random);
    let region = |x, y, width, height| Some(Region { x, y, width, height });
    let flat =
        [[1, 1], [16, 1], [17, 1], [40, 2], [128, 1], [129, 1], [130, 2], [256, 1], [300, 1], [300, 2], [530, 1]]
            .map(|size| (size, None));
    let cut = [
        ([300, 1], region(120, 0, 9, 1)),
        ([300, 1], region(20, 0, 120, 1)),
        ([600, 7], region(200, 3, 320, 1)),
        ([600, 7], region(258, 4, 200, 1)),
        ([300, 2], region(97, 1, 150, 1)),
        ([150, 40], region(3, 22, 140, 2)),
        ([150, 40], region(3, 21, 140, 2)),
        ([150, 40], region(125, 17, 6, 1)),
        ([150, 40], region(20, 39, 130, 1)),
        ([17, 30], region(4, 28, 26, 31)),
        ([17, 6], region(12, 5, 6, 36)),
        ([34, 3], region(10, 0, 9, 2)),
    ];
    for (size, scissor) in flat.into_iter().chain(cut) {
        for target in [TexelFormat::Rgba32f, TexelFormat::Bgra8, TexelFormat::Rgba16f] {
            let state = SamplerState::NEAREST_CLAMP;
            let case = Case { size, scissor, texture: texture.clone(), state, target };
            agrees(&case, &triangles(25, &mut random));
        }
    }
}

#[test]
fn textures_without_a_table_are_read_alike() {
    let mut random = Random::new(2);
    let formats = [TexelFormat::Rgba32f, TexelFormat::Rgba16f, TexelFormat::R32f, TexelFormat::Bgra8, TexelFormat::L16];
    for format in formats {
        let texture = image(format, 600, &mut random);
        for mode in [AddressMode::Wrap, AddressMode::Mirror, AddressMode::Clamp, AddressMode::Border] {
            let border = [0.25_f32, 0.5, 0.75, 1.0].map(f32::to_bits);
            let state = SamplerState { address_u: mode, address_v: mode, border, ..SamplerState::NEAREST_CLAMP };
            let case =
                Case { size: [50, 21], scissor: None, texture: texture.clone(), state, target: TexelFormat::Rgba32f };
            agrees(&case, &triangles(12, &mut random));
        }
    }
}
