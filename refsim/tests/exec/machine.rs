//! Tests the emulated card through its public interface: draws, counts, errors, threads.

mod mipmaps;
mod mistakes;

use crate::random::Random;
use crate::running::{self, bits, checked, constants, ideal, image};
use refsim::device::Profile;
use refsim::event::DrawEvents;
use refsim::exec::{CheckedProgram, Constants};
use refsim::machine::{
    AttributeStream, DrawCall, ExecutorKind, Machine, MachineError, StepRate, TextureId, VertexSource, VertexStreams,
};
use refsim::output::{BlendFactor, BlendOp, BlendState, CompareFunction, DepthFormat, DepthState, WriteMask};
use refsim::raster::{Primitive, Vertex};
use refsim::texture::{Filter, Image, Region, SamplerState, TexelFormat};

/// Corners of a quad that covers a target of `n` x `n` pixels; its coordinates hit the texel centers of an n x n
/// texture.
pub(crate) fn screen(n: u32) -> Vec<Vertex> {
    // Shifted up and left by half a pixel, because Direct3D 9 has pixel centers at integers.
    let step = 1.0 / n as f32;
    let corner = |vertex: Vertex| {
        let [x, y, ..] = vertex.position.map(f32::from_bits);
        let (position, colors) = (bits([x - step, y + step, 0.5, 1.0]), [bits([0.25, 0.5, 0.75, 1.0]); 2]);
        Vertex { position, colors, ..vertex }
    };
    running::screen().map(corner).to_vec()
}

fn gradient(n: u32) -> Image {
    let values: Vec<[u32; 4]> =
        (0..n * n).map(|i| bits([(i % n) as f32 / 255.0, (i / n) as f32 / 255.0, 0.5, 1.0])).collect();
    image(TexelFormat::Rgba8, [n; 2], &values)
}

fn pixel(image: &Image, x: u32, y: u32) -> [u8; 4] {
    (image.raw(0, 0, y, x) as u32).to_le_bytes()
}

/// A draw of quads with pixel centers at integers.
fn quads<'a>(
    vertices: &'a [Vertex],
    program: &'a CheckedProgram,
    host: &'a Constants,
    target: TextureId,
) -> DrawCall<'a> {
    DrawCall::new(VertexSource::Transformed(vertices), Primitive::QuadList, program, host, target)
}

const COLOR: &str = "ps_1_4\nmov r0, v0";

#[test]
fn ps_1_4_and_ps_2_0_copy_a_texture_through_a_full_screen_quad() {
    let texts =
        [("r200", "ps_1_4\ntexld r0, t0"), ("r300", "ps_2_0\ndcl t0\ndcl_2d s0\ntexld r0, t0, s0\nmov oC0, r0")];
    for (device, text) in texts {
        let n = 40;
        let profile = Profile::named(device).unwrap();
        let program = checked(text, &profile);
        let mut machine = Machine::new(profile, ExecutorKind::Scalar);
        let texture = machine.create_texture(gradient(n)).unwrap();
        let target = machine.create_target(TexelFormat::Bgra8, n, n).unwrap();
        let vertices = screen(n);
        let host = Constants::default();
        let call = quads(&vertices, &program, &host, target).with_texture(0, texture, SamplerState::NEAREST_CLAMP);
        let events = machine.draw(&call).unwrap();
        assert_eq!(events.fragments.passed, u64::from(n * n), "{device}: every pixel once");
        assert_eq!(events.fragments.fetches[0], u64::from(n * n));
        assert_eq!(events.bytes.textures, 4 * u64::from(n * n));
        assert_eq!(events.bytes.color_written, 4 * u64::from(n * n));
        let image = machine.read_back(target).unwrap();
        for y in 0..n {
            for x in 0..n {
                assert_eq!(pixel(image, x, y), [128, y as u8, x as u8, 255], "{device}: ({x}, {y})");
            }
        }
    }
}

/// The program has more live values than sixteen bits can index.
#[test]
fn programs_of_any_length_agree() {
    let steps = "mul r0,r0,t0\nmad r1,r0,v0,r1\n".repeat(17_000);
    let text = format!("ps_2_a\ndcl t0\ndcl v0\nmov r0,v0\nmov r1,v0\n{steps}mov oC0,r1");
    let profile = ideal("fp32");
    let program = checked(&text, &profile);
    let mut bytes = Vec::new();
    for kind in [ExecutorKind::Scalar, ExecutorKind::Batch] {
        let mut machine = Machine::new(profile.clone(), kind);
        let target = machine.create_target(TexelFormat::Rgba32f, 2, 2).unwrap();
        let mut vertices = screen(2);
        for (i, vertex) in vertices.iter_mut().enumerate() {
            vertex.texcoords[0] = bits([1.0 + i as f32 / 65536.0, 0.999, 1.0, 0.5]);
        }
        let host = Constants::default();
        machine.draw(&quads(&vertices, &program, &host, target)).unwrap();
        bytes.push(machine.read_back(target).unwrap().bytes().to_vec());
    }
    assert_eq!(bytes[0], bytes[1]);
}

fn random_quads(count: usize) -> Vec<Vertex> {
    let mut random = Random::new(7);
    let mut next = || random.unit();
    let mut out = Vec::new();
    for _ in 0..count {
        let (x, y, w, h) = (next() * 2.0 - 1.2, next() * 2.0 - 1.2, next() * 1.5, next() * 1.5);
        for (dx, dy) in [(0.0, 0.0), (w, 0.0), (w, h), (0.0, h)] {
            let scale = 1.0 + next();
            out.push(Vertex {
                position: bits([(x + dx) * scale, (y + dy) * scale, next() * scale, scale]),
                colors: [bits([next(), next(), next(), next()]); 2],
                texcoords: [bits([next(), next(), next(), 1.0]); 8],
                ..Vertex::default()
            });
        }
    }
    out
}

/// Draws quads with depth test and blending, in one call or in one call per quad.
fn draw_quads(
    machine: &mut Machine,
    program: &CheckedProgram,
    vertices: &[Vertex],
    at_once: bool,
) -> (Vec<u8>, Vec<u32>, DrawEvents) {
    let host = Constants::default();
    let texture = machine.create_texture(gradient(16)).unwrap();
    let target = machine.create_target(TexelFormat::Bgra8, 50, 37).unwrap();
    let depth = machine.create_depth(DepthFormat::Unorm24, 50, 37).unwrap();
    let mut total = DrawEvents::default();
    let step = if at_once { vertices.len() } else { 4 };
    for part in vertices.chunks(step) {
        let mut call = quads(part, program, &host, target).with_texture(0, texture, SamplerState::NEAREST_CLAMP);
        call.depth_buffer = Some(depth);
        call.depth = DepthState { test: Some(CompareFunction::LessEqual), write: true };
        call.blend = Some(BlendState::both(BlendFactor::SrcAlpha, BlendFactor::InvSrcAlpha, BlendOp::Add));
        total += machine.draw(&call).unwrap();
    }
    let color = machine.read_back(target).unwrap().bytes().to_vec();
    (color, machine.read_depth(depth).unwrap().data().to_vec(), total)
}

const TEXTURED: &str = "ps_1_4\ntexld r0, t0\nmul r0.rgb, r0, v0\n+mov r0.a, v0.a";

#[test]
fn fifty_quads_at_once_are_fifty_draws_on_any_number_of_threads() {
    let profile = Profile::named("r200").unwrap();
    let program = checked(TEXTURED, &profile);
    let vertices = random_quads(50);
    let run = |threads, at_once| {
        let mut machine = Machine::with_threads(profile.clone(), ExecutorKind::Scalar, threads).unwrap();
        draw_quads(&mut machine, &program, &vertices, at_once)
    };
    let one = run(1, true);
    assert!(one.2.fragments.passed > 1000 && one.2.fragments.depth_failed > 100, "the scene has both: {:?}", one.2);
    assert_eq!(one, run(2, true));
    assert_eq!(one, run(3, true));
    let (color, depth, total) = one;
    assert_eq!((color, depth, DrawEvents { draws: 50, instances: 50, ..total }), run(1, false));
}

#[test]
fn the_crossbar_draws_instances_in_order() {
    let profile = ideal("e8m23");
    let vs = checked("vs_1_1\ndcl_position v0\ndcl_color v1\nmov oPos, v0\nmov oD0, v1\nmov oPos.z, v1.w", &profile);
    let ps = checked("ps_2_0\ndcl v0\nmov oC0, v0", &profile);
    let mut machine = Machine::new(profile, ExecutorKind::Scalar);
    let target = machine.create_target(TexelFormat::Rgba32f, 20, 20).unwrap();
    let depth = machine.create_depth(DepthFormat::Float32, 20, 20).unwrap();
    let corners =
        [[-1.05, 1.05, 0.0, 1.0], [0.95, 1.05, 0.0, 1.0], [0.95, -0.95, 0.0, 1.0], [-1.05, -0.95, 0.0, 1.0]].map(bits);
    // The depth decreases and increases again; instance 9000 of 12,000 is the nearest, and of equal depths the last
    // wins.
    let count = 12_000;
    let colors: Vec<[u32; 4]> = (0..count)
        .map(|i: i32| bits([i as f32 / count as f32, 0.0, 0.0, 0.25 + (i - 9000).abs() as f32 / 32_768.0]))
        .collect();
    let host = Constants::default();
    let streams = VertexStreams {
        vertex_count: 4,
        instance_count: count as usize,
        streams: vec![
            AttributeStream { register: 0, step: StepRate::Vertex, data: &corners },
            AttributeStream { register: 1, step: StepRate::Instance, data: &colors },
        ],
    };
    // 2x2 pixels, for speed.
    let vertices = VertexSource::Program { program: &vs, constants: &host, streams };
    let mut call = DrawCall::new(vertices, Primitive::QuadList, &ps, &host, target);
    call.scissor = Some(Region { x: 15, y: 15, width: 2, height: 2 });
    call.depth_buffer = Some(depth);
    call.depth = DepthState { test: Some(CompareFunction::LessEqual), write: true };
    let events = machine.draw(&call).unwrap();
    assert_eq!((events.instances, events.vertices), (12_000, 48_000));
    assert_eq!(events.vertex_instructions, 3 * 48_000);
    assert_eq!(events.primitives.assembled, 24_000);
    assert_eq!(events.fragments.shaded, 4 * 12_000);
    assert_eq!(events.fragments.passed, 4 * 9001);
    assert_eq!(events.bytes.vertices, 16 * 48_000 + 16 * 12_000);
    let image = machine.read_back(target).unwrap();
    for (x, y) in [(15, 15), (16, 15), (15, 16), (16, 16)] {
        assert_eq!(image.raw(0, 0, y, x) as u32, 0.75f32.to_bits());
    }
    assert_eq!(image.raw(0, 0, 14, 14), 0, "outside the scissor");
    assert_eq!(machine.read_depth(depth).unwrap().get(16, 16), Some(0.25f32.to_bits()));
}

#[test]
fn kills_tests_and_masks_are_counted_and_obeyed() {
    let profile = Profile::named("r200").unwrap();
    let text = "ps_1_4\ntexcrd r0.rgb, t0\nphase\ntexkill r0\nmov r0, v0";
    let program = checked(text, &profile);
    let mut machine = Machine::new(profile, ExecutorKind::Scalar);
    let target = machine.create_target(TexelFormat::Bgra8, 16, 16).unwrap();
    let mut vertices = screen(16);
    for v in &mut vertices {
        // u from -0.5 to 0.5: the left half is killed.
        let u = f32::from_bits(v.texcoords[0][0]) - 0.5;
        v.texcoords[0][0] = u.to_bits();
    }
    let host = Constants::default();
    let mut call = DrawCall::new(VertexSource::Transformed(&vertices), Primitive::TriangleFan, &program, &host, target);
    call.masks[0] = WriteMask(0b0101);
    let events = machine.draw(&call).unwrap();
    assert_eq!(events.fragments.generated, 256);
    assert_eq!((events.fragments.killed, events.fragments.passed), (128, 128));
    assert_eq!(events.bytes.color_read, 4 * 128, "a partial mask reads");
    let image = machine.read_back(target).unwrap();
    assert_eq!((pixel(image, 7, 3), pixel(image, 8, 3)), ([0; 4], [191, 0, 64, 0]));
    call.indices = Some(&[0, 1, 2]);
    assert_eq!(machine.draw(&call).unwrap().primitives.assembled, 1);
}

#[test]
fn rendering_to_a_texture_and_reading_it() {
    let profile = Profile::named("r300").unwrap();
    let fill = checked("ps_2_0\ndcl v0\nmov oC0, v0", &profile);
    let copy = checked("ps_2_0\ndcl t0\ndcl_2d s0\ntexld r0, t0, s0\nadd r0, r0, r0\nmov oC0, r0", &profile);
    let mut machine = Machine::new(profile, ExecutorKind::Scalar);
    let a = machine.create_target(TexelFormat::Rgba32f, 8, 8).unwrap();
    let b = machine.create_target(TexelFormat::Rgba32f, 8, 8).unwrap();
    let vertices = screen(8);
    let host = Constants::default();
    machine.draw(&quads(&vertices, &fill, &host, a)).unwrap();
    let second = quads(&vertices, &copy, &host, b).with_texture(0, a, SamplerState::NEAREST_CLAMP);
    machine.draw(&second).unwrap();
    assert_eq!(machine.read_back(b).unwrap().raw(0, 0, 5, 5) as u32, 0.5f32.to_bits());
    let lost = quads(&vertices, &copy, &host, a).with_texture(0, a, SamplerState::NEAREST_CLAMP);
    assert_eq!(machine.draw(&lost), Err(MachineError::FeedbackLoop { sampler: 0, target: 0 }));
}

#[test]
fn float_textures_are_filtered_only_where_the_card_can() {
    let profile = Profile::named("nv30").unwrap();
    let program = checked("ps_2_0\ndcl t0\ndcl_2d s0\ntexld r0, t0, s0\nmov oC0, r0", &profile);
    let mut machine = Machine::new(profile, ExecutorKind::Scalar);
    let texture = machine.create_texture(Image::new_2d(TexelFormat::Rgba32f, 4, 4).unwrap()).unwrap();
    let target = machine.create_target(TexelFormat::Rgba32f, 8, 8).unwrap();
    let vertices = screen(8);
    let host = constants(&[]);
    let linear = SamplerState { mag: Filter::Linear, ..SamplerState::NEAREST_CLAMP };
    let mut call = quads(&vertices, &program, &host, target).with_texture(0, texture, linear);
    assert!(matches!(machine.draw(&call), Err(MachineError::FloatFilter { sampler: 0, .. })));
    call.samplers[0].as_mut().unwrap().state = SamplerState::NEAREST_CLAMP;
    call.blend = Some(BlendState::both(BlendFactor::One, BlendFactor::One, BlendOp::Add));
    assert!(matches!(machine.draw(&call), Err(MachineError::FloatBlend { target: 0, .. })));
}

#[test]
fn resources_can_be_changed_cleared_and_released() {
    let mut machine = Machine::new(ideal("e8m23"), ExecutorKind::Scalar);
    let texture = machine.create_texture(gradient(4)).unwrap();
    machine.clear_target(texture, bits([1.0, 0.0, 0.0, 1.0])).unwrap();
    assert_eq!(pixel(machine.read_back(texture).unwrap(), 3, 3), [255, 0, 0, 255]);
    machine.update_texture(texture, &gradient(4)).unwrap();
    assert_eq!(pixel(machine.read_back(texture).unwrap(), 3, 2), [3, 2, 128, 255]);
    assert!(machine.update_texture(texture, &gradient(5)).is_err());
    machine.release_texture(texture).unwrap();
    assert!(matches!(machine.read_back(texture), Err(MachineError::NoSuchResource { .. })));
    let depth = machine.create_depth(DepthFormat::Unorm16, 4, 4).unwrap();
    machine.clear_depth(depth, 0.5f32.to_bits()).unwrap();
    assert_eq!(machine.read_depth(depth).unwrap().get(0, 0), Some(0x8000));
    machine.release_depth(depth).unwrap();
    assert!(machine.release_depth(depth).is_err());
}

/// Draws copies of a texture: executors may cache decoded contents only until the texture changes.
#[test]
fn a_changed_texture_is_read_as_it_is_now() {
    let profile = Profile::named("r300").unwrap();
    let program = checked("ps_2_0\ndcl t0\ndcl_2d s0\ntexld r0, t0, s0\nmov oC0, r0", &profile);
    for kind in [ExecutorKind::Scalar, ExecutorKind::Batch] {
        let n = 16;
        let mut machine = Machine::new(profile.clone(), kind);
        let texture = machine.create_target_from(gradient(n)).unwrap();
        let other = machine.create_texture(gradient(n)).unwrap();
        let target = machine.create_target(TexelFormat::Rgba8, n, n).unwrap();
        let (vertices, host) = (screen(n), Constants::default());
        let copy = |machine: &mut Machine, from, to| {
            let call = quads(&vertices, &program, &host, to).with_texture(0, from, SamplerState::NEAREST_CLAMP);
            machine.draw(&call).unwrap();
            machine.read_back(to).unwrap().clone()
        };
        let first = copy(&mut machine, texture, target);
        assert_eq!(first, gradient(n), "{kind:?}: as created");
        assert_eq!(copy(&mut machine, texture, target), first, "{kind:?}: again");
        let mut changed = gradient(n);
        changed.set_raw(0, 0, 3, 5, 0x1234_5678);
        machine.update_texture(texture, &changed).unwrap();
        assert_eq!(copy(&mut machine, texture, target), changed, "{kind:?}: updated");
        machine.clear_target(texture, bits([1.0, 0.0, 1.0, 0.0])).unwrap();
        assert_eq!(pixel(&copy(&mut machine, texture, target), 5, 3), [255, 0, 255, 0], "{kind:?}: cleared");
        assert_eq!(copy(&mut machine, other, texture), gradient(n), "{kind:?}: drawn into");
        assert_eq!(copy(&mut machine, texture, target), gradient(n), "{kind:?}: as drawn");
        assert_eq!(machine.release_texture(texture).unwrap(), machine.release_texture(other).unwrap(), "{kind:?}");
    }
}
