//! Tests draws on a GPU against the reference: targets, depth buffers and counts must be bit-identical.

#[path = "common/adapter.rs"]
mod adapter;
#[path = "common/environment.rs"]
mod environment;
#[path = "common/random.rs"]
mod random;
#[path = "common/running.rs"]
mod running;
#[path = "common/sums.rs"]
mod sums;

use environment::by_form;
use random::Random;
use refsim::device::Profile;
use refsim::exec::gpu::{BINDINGS, Gpu};
use refsim::exec::wgsl::follow::{ENTRY, FRAGMENT, HEAD, STEP_WORDS, UNFINISHED, module};
use refsim::exec::wgsl::kernel::RESUMES;
use refsim::exec::{CheckedProgram, Constants};
use refsim::machine::{DepthId, DrawCall, ExecutorKind, Machine, TextureId, VertexSource};
use refsim::num::Format;
use refsim::output::{CompareFunction, DepthFormat, DepthState};
use refsim::raster::{Primitive, Vertex};
use refsim::texture::{Filter, Image, SamplerState, TargetRounding, TexelFormat, TextureKind};
use running::{bits, checked, ideal};
use std::process::ExitCode;
use std::sync::Arc;

fn main() -> ExitCode {
    adapter::run(adapter::trials![on_adapter:
        memory_follows,
        products_and_sums_agree,
        short_programs_agree_on_any_driver,
        units_of_cards_agree,
        buffers_of_a_trace_run_elsewhere,
    ])
}

fn vertices(random: &mut Random, count: usize) -> Vec<Vertex> {
    let flat = random.coin();
    (0..count)
        .map(|_| {
            let w = if flat { 1.0 } else { random.between(0.2, 3.0) };
            let [x, y] = [random.between(-1.4, 1.4) * w, random.between(-1.4, 1.4) * w];
            let color = [0; 4].map(|_| random.between(-0.5, 1.5));
            Vertex {
                position: bits([x, y, random.between(-0.1, 1.1) * w, w]),
                texcoords: [bits(color); 8],
                colors: [bits(color); 2],
                ..Vertex::default()
            }
        })
        .collect()
}

/// A scalar reference machine and a GPU machine, given the same resources and draws.
struct Pair {
    reference: Machine,
    device: Machine,
}

impl Pair {
    fn new(profile: &Profile, gpu: &Arc<Gpu>) -> Self {
        Self {
            reference: Machine::new(profile.clone(), ExecutorKind::Scalar),
            device: Machine::with_gpu(profile.clone(), Arc::clone(gpu)).unwrap(),
        }
    }

    fn target(&mut self, format: TexelFormat, width: u32, height: u32, color: [u32; 4]) -> TextureId {
        let id = self.reference.create_target(format, width, height).unwrap();
        assert_eq!(self.device.create_target(format, width, height), Ok(id));
        self.reference.clear_target(id, color).unwrap();
        self.device.clear_target(id, color).unwrap();
        id
    }

    fn depth(&mut self, format: DepthFormat, width: u32, height: u32, depth: u32) -> DepthId {
        let id = self.reference.create_depth(format, width, height).unwrap();
        assert_eq!(self.device.create_depth(format, width, height), Ok(id));
        self.reference.clear_depth(id, depth).unwrap();
        self.device.clear_depth(id, depth).unwrap();
        id
    }

    fn draw(&mut self, call: &DrawCall<'_>, what: &str) {
        let expected = self.reference.draw(call).unwrap();
        let found = self.device.draw(call).unwrap_or_else(|e| panic!("{what}: {e}"));
        assert_eq!(found, expected, "{what}: counts");
    }

    fn same(&self, targets: &[TextureId], depth: Option<DepthId>, what: &str) {
        for &id in targets {
            let (expected, found) = (self.reference.read_back(id).unwrap(), self.device.read_back(id).unwrap());
            let size = expected.format().bytes();
            let differs = expected.bytes().chunks(size).zip(found.bytes().chunks(size)).position(|(a, b)| a != b);
            if let Some(i) = differs {
                let (x, y) = (i % expected.width() as usize, i / expected.width() as usize);
                let at = |image: &Image| image.raw(0, 0, y as u32, x as u32);
                panic!("{what}: {} ({x}, {y}): expected {:x}, found {:x}", expected.format(), at(expected), at(found));
            }
        }
        if let Some(id) = depth {
            let (expected, found) = (self.reference.read_depth(id).unwrap(), self.device.read_depth(id).unwrap());
            let differs = expected.data().iter().zip(found.data()).position(|(a, b)| a != b);
            if let Some(i) = differs {
                panic!("{what}: depth {i}: expected {:x}, found {:x}", expected.data()[i], found.data()[i]);
            }
        }
    }
}

fn copy(profile: &Profile) -> CheckedProgram {
    checked("ps_2_0\ndcl t0\nmov oC0, t0", profile)
}

/// Rules for products and sums, with each format of the list used twice.
fn products_and_sums_agree(gpu: &Arc<Gpu>) {
    // Each draw has its own shader, which a driver compiles for seconds. Formats alternate.
    for seed in (0..24).step_by(by_form(5, 1)) {
        let profile = sums::profile(seed);
        let expected = sums::drawn(Machine::new(profile.clone(), ExecutorKind::Scalar), &profile, seed);
        let found = sums::drawn(Machine::with_gpu(profile.clone(), Arc::clone(gpu)).unwrap(), &profile, seed);
        assert!(found == expected, "seed {seed}: {:?}", profile.rules);
    }
}

/// Tests handles, clears, releases and read-back between draws.
fn memory_follows(gpu: &Arc<Gpu>) {
    let profile = ideal("fp32");
    let program = copy(&profile);
    let host = Constants::default();
    let mut pair = Pair::new(&profile, gpu);
    let mut random = Random::new(5);
    let first = pair.target(TexelFormat::Rgba8, 33, 17, bits([0.5; 4]));
    let second = pair.target(TexelFormat::Bgr565, 33, 17, bits([0.25; 4]));
    let corners = vertices(&mut random, 6);
    let draw = |pair: &mut Pair, target| {
        let call = DrawCall::new(VertexSource::Transformed(&corners), Primitive::TriangleList, &program, &host, target);
        pair.draw(&call, "memory");
        pair.same(&[target], None, "memory");
    };
    draw(&mut pair, first);
    draw(&mut pair, second);
    for machine in [&mut pair.reference, &mut pair.device] {
        machine.clear_target(first, bits([1.0, 0.0, 0.5, 0.25])).unwrap();
    }
    pair.same(&[first, second], None, "cleared");
    draw(&mut pair, first);
    let image = pair.reference.read_back(second).unwrap().clone();
    pair.device.update_texture(first, &image).unwrap_err();
    let released = [pair.reference.release_texture(first), pair.device.release_texture(first)];
    assert_eq!(released[0], released[1], "what is released is what was drawn");
    // Reuses the memory of the first on the GPU.
    let third = pair.target(TexelFormat::Rgba16f, 33, 17, bits([0.125; 4]));
    draw(&mut pair, third);
    pair.same(&[second, third], None, "a new target");
}

/// Compares short programs, for drivers that compile slowly.
fn short_programs_agree_on_any_driver(gpu: &Arc<Gpu>) {
    for (device, text) in [
        ("ideal-fp32", "ps_2_0\ndcl t0\nmad r0, t0, c0, c1\nmov oC0, r0"),
        ("r200", "ps_1_4\ntexld r0, t0\nmad r0, r0, c0, r0"),
    ] {
        let profile = Profile::named(device).unwrap();
        let program = checked(text, &profile);
        let host = running::constants(&[[0.5, -0.25, 0.125, 1.0]; 4]);
        let mut pair = Pair::new(&profile, gpu);
        let mut random = Random::new(77);
        let target = pair.target(TexelFormat::Bgra8, 24, 24, [0; 4]);
        let depth = pair.depth(DepthFormat::Unorm24, 24, 24, 0x3f80_0000);
        let image = texture(&mut random);
        let id = pair.reference.create_texture(image.clone()).unwrap();
        assert_eq!(pair.device.create_texture(image), Ok(id));
        for filter in [Filter::Nearest, Filter::Linear] {
            let corners = vertices(&mut random, 9);
            let source = VertexSource::Transformed(&corners);
            let state = SamplerState { min: filter, mag: filter, ..SamplerState::NEAREST_CLAMP };
            let mut call =
                DrawCall::new(source, Primitive::TriangleList, &program, &host, target).with_texture(0, id, state);
            call.depth_buffer = Some(depth);
            call.depth = DepthState { test: Some(CompareFunction::LessEqual), write: true };
            pair.draw(&call, text);
            pair.same(&[target], Some(depth), text);
        }
    }
}

/// Programs in the units of cards, on numbers of every size.
fn units_of_cards_agree(gpu: &Arc<Gpu>) {
    let text = "ps_2_0\ndcl t0\ndcl t1\ndcl_2d s0\ntexld r2, t0, s0\nmul r0, t0, c0\nmad r1, t1, r0, -c1\n\
                dp3 r0.x, r1, t1\ndp4 r0.y, r0, c2\nrcp r3.x, r1.y\nrsq r3.y, r1.x\nexp r3.z, t0.x\nlog r3.w, t1.y\n\
                min r1, r1, r3\nmax_sat r3, r3, r2\nfrc r4, r1\ncmp r4, r0, r4, r2\nlrp r1, c3, r3, r1\n\
                sub r1, r1, r0\nmov oC0, r1\nmov oC1, r4\nmov oC2, r0";
    let huge =
        [[3.0e38, -1.0e-38, 0.125, 1.0], [0.3, -7.0, 1.0e20, f32::INFINITY], [1.0e-40, 2.0, -0.7, 5.0], [0.3; 4]];
    for (seed, unit) in (0..).zip(["nv3x", "gt200", "nv2x", "gt200-zero-wins"]) {
        let mut profile = ideal("fp32");
        profile.set_format(format!("e8m23:{unit}").parse().unwrap()).unwrap();
        let program = checked(text, &profile);
        let host = running::constants(&huge);
        let mut pair = Pair::new(&profile, gpu);
        let mut random = Random::new(seed);
        let formats = [TexelFormat::Rgba32f, TexelFormat::Rgba16f, TexelFormat::Rgba8];
        let targets = formats.map(|format| pair.target(format, 24, 24, [0; 4]));
        let image = texture(&mut random);
        let id = pair.reference.create_texture(image.clone()).unwrap();
        assert_eq!(pair.device.create_texture(image), Ok(id));
        let corners = vertices(&mut random, 12);
        let source = VertexSource::Transformed(&corners);
        let mut call = DrawCall::new(source, Primitive::TriangleList, &program, &host, targets[0]).with_texture(
            0,
            id,
            SamplerState::NEAREST_CLAMP,
        );
        call.targets = targets.to_vec();
        pair.draw(&call, unit);
        pair.same(&targets, None, unit);
    }
}

fn texture(random: &mut Random) -> Image {
    let values: Vec<[u32; 4]> = (0..64).map(|_| bits([0; 4].map(|_| random.between(0.0, 1.0)))).collect();
    let kind = TextureKind::D2;
    Image::from_values(TexelFormat::Rgba8, kind, [8, 8, 1], Format::FP32, &values, TargetRounding::Nearest).unwrap()
}

/// The buffers of a trace yield the first fragment of each pixel, in several dispatches if the trace is long.
fn buffers_of_a_trace_run_elsewhere(gpu: &Arc<Gpu>) {
    let profile = ideal("fp32");
    let reads = "texld r1, r0, s0\nmad r0, r1, c0, r0\n".repeat(3);
    let program = checked(&format!("ps_2_0\ndcl t0\ndcl_2d s0\nmov r0, t0\n{reads}mov oC0, r0"), &profile);
    let host = running::constants(&[[0.5, -0.25, 0.125, 1.0]]);
    let mut machine = Machine::new(profile.clone(), ExecutorKind::Scalar);
    let target = machine.create_target(TexelFormat::Bgra8, 9, 7).unwrap();
    let mut random = Random::new(5);
    let image = machine.create_texture(texture(&mut random)).unwrap();
    let corners = vertices(&mut random, 9);
    let source = VertexSource::Transformed(&corners);
    let call = DrawCall::new(source, Primitive::TriangleList, &program, &host, target);
    let call = call.with_texture(0, image, SamplerState::NEAREST_CLAMP);
    let pixels: Vec<(u32, u32)> = (0..63).map(|i| (i % 9, i / 9)).collect();

    let made = machine.trace_buffers(&call, &pixels).unwrap();
    let pipeline = gpu.pipeline(&made.parts.of(&module(), ENTRY), ENTRY, &BINDINGS).unwrap();
    let mut video = made.video.clone();
    video.resize(made.video.len() + pixels.len() * made.record_words, 0);
    let (scratch, counts) = (vec![0; made.scratch_words], vec![0; made.count_words]);
    let buffers = [&made.draw, &made.setups, &made.tiles, &made.samplers, &video, &made.code, &scratch, &counts]
        .map(|words| gpu.buffer_of(words).unwrap());
    let records = loop {
        gpu.dispatch(&pipeline, &buffers.each_ref(), [pixels.len() as u32, 1, 1]).unwrap();
        let found = gpu.read(&buffers[4], made.video.len()..video.len()).unwrap();
        if !found.chunks_exact(made.record_words).any(|words| words[0] == UNFINISHED) {
            break found;
        }
        gpu.upload(&buffers[0], RESUMES, &[1]).unwrap();
    };
    let mut covered = 0;
    let expected = machine.trace_pixels(&call, &pixels).unwrap();
    for ((words, fragments), &(x, y)) in records.chunks_exact(made.record_words).zip(expected).zip(&pixels) {
        assert_eq!(words[0] == FRAGMENT, !fragments.is_empty(), "{x}, {y}");
        let Some(fragment) = fragments.first() else { continue };
        covered += 1;
        assert_eq!(words[1], 4, "{x}, {y}: passed");
        let count = program.instructions.len() as u32;
        // The raw values of fp32 are its patterns.
        let found: Vec<_> = words[HEAD..][..words[2] as usize]
            .chunks_exact(STEP_WORDS)
            .filter(|step| step[0] < count)
            .map(|step| (step[0] as usize, step[1] & 15, std::array::from_fn(|c| step[2 + c] * (step[1] >> c & 1))))
            .collect();
        let expected: Vec<_> =
            fragment.shading.steps.iter().map(|step| (step.instruction, u32::from(step.mask.0), step.value)).collect();
        assert_eq!(found, expected, "{x}, {y}");
    }
    assert!((1..pixels.len()).contains(&covered), "{covered}");
}
