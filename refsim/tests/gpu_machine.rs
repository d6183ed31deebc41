//! Tests draws on a GPU against the reference: targets and counts must be bit-identical. tests/agree draws random
//! programs and states.

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
use refsim::exec::Constants;
use refsim::exec::gpu::{BINDINGS, Gpu};
use refsim::exec::wgsl::follow::{ENTRY, FRAGMENT, HEAD, STEP_WORDS, UNFINISHED, module};
use refsim::exec::wgsl::kernel::RESUMES;
use refsim::machine::{DrawCall, ExecutorKind, Machine, VertexSource};
use refsim::output::{CompareFunction, DepthFormat, DepthState};
use refsim::raster::{Primitive, Vertex};
use refsim::texture::{Filter, Image, SamplerState, TexelFormat};
use running::{bits, checked, ideal, image};
use std::fmt::Debug;
use std::process::ExitCode;
use std::sync::Arc;

fn main() -> ExitCode {
    adapter::run(adapter::trials![on_adapter:
        memory_follows,
        products_and_sums_agree,
        short_programs_agree_on_any_driver,
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

fn both<T: PartialEq + Debug>(machines: &mut [Machine; 2], ask: impl Fn(&mut Machine) -> T) -> T {
    let [expected, found] = machines.each_mut().map(ask);
    assert_eq!(found, expected);
    expected
}

fn pair(profile: &Profile, gpu: &Arc<Gpu>) -> [Machine; 2] {
    let device = Machine::with_gpu(profile.clone(), Arc::clone(gpu)).unwrap();
    [Machine::new(profile.clone(), ExecutorKind::Scalar), device]
}

/// Compares short programs, for drivers that compile slowly.
fn short_programs_agree_on_any_driver(gpu: &Arc<Gpu>) {
    for (device, text) in [
        ("ideal-fp32", "ps_2_0\ndcl t0\nmad r0, t0, c0, c1\nmov oC0, r0"),
        ("r200", "ps_1_4\ntexld r0, t0\nmad r0, r0, c0, r0"),
    ] {
        let profile = Profile::named(device).unwrap();
        let (program, host) = (checked(text, &profile), running::constants(&[[0.5, -0.25, 0.125, 1.0]; 4]));
        let (machines, mut random) = (&mut pair(&profile, gpu), Random::new(77));
        let target = both(machines, |machine| machine.create_target(TexelFormat::Bgra8, 24, 24).unwrap());
        let depth = both(machines, |machine| {
            let depth = machine.create_depth(DepthFormat::Unorm24, 24, 24).unwrap();
            machine.clear_depth(depth, 0x3f80_0000).unwrap();
            depth
        });
        let texels: Vec<_> = (0..64).map(|_| bits([0; 4].map(|_| random.between(0.0, 1.0)))).collect();
        let texture = image(TexelFormat::Rgba8, [8, 8], &texels);
        let texture = both(machines, |machine| machine.create_texture(texture.clone()).unwrap());
        for filter in [Filter::Nearest, Filter::Linear] {
            let corners = vertices(&mut random, 9);
            let source = VertexSource::Transformed(&corners);
            let state = SamplerState { min: filter, mag: filter, ..SamplerState::NEAREST_CLAMP };
            let mut call =
                DrawCall::new(source, Primitive::TriangleList, &program, &host, target).with_texture(0, texture, state);
            call.depth_buffer = Some(depth);
            call.depth = DepthState { test: Some(CompareFunction::LessEqual), write: true };
            both(machines, |machine| machine.draw(&call).unwrap());
            both(machines, |machine| machine.read_back(target).unwrap().clone());
            both(machines, |machine| machine.read_depth(depth).unwrap().data().to_vec());
        }
    }
}

/// Tests handles, clears, releases and read-back between draws.
fn memory_follows(gpu: &Arc<Gpu>) {
    let profile = ideal("fp32");
    let program = checked("ps_2_0\ndcl t0\nmov oC0, t0", &profile);
    let (host, corners) = (Constants::default(), vertices(&mut Random::new(5), 6));
    let machines = &mut pair(&profile, gpu);
    let create = |machines: &mut [Machine; 2], format, grey: f32| {
        both(machines, |machine| {
            let target = machine.create_target(format, 33, 17).unwrap();
            machine.clear_target(target, bits([grey; 4])).unwrap();
            target
        })
    };
    let image = |machines: &mut [Machine; 2], target| both(machines, |m| m.read_back(target).unwrap().clone());
    let draw = |machines: &mut [Machine; 2], target| {
        let call = DrawCall::new(VertexSource::Transformed(&corners), Primitive::TriangleList, &program, &host, target);
        both(machines, |machine| machine.draw(&call).unwrap());
        image(machines, target)
    };
    let first = create(machines, TexelFormat::Rgba8, 0.5);
    let second = create(machines, TexelFormat::Bgr565, 0.25);
    draw(machines, first);
    let drawn = draw(machines, second);
    both(machines, |machine| machine.clear_target(first, bits([1.0, 0.0, 0.5, 0.25])).unwrap());
    image(machines, first);
    draw(machines, first);
    machines[1].update_texture(first, &drawn).unwrap_err();
    both(machines, |machine| machine.release_texture(first).unwrap());
    // Reuses the memory of the first on the GPU.
    let third = create(machines, TexelFormat::Rgba16f, 0.125);
    draw(machines, third);
    assert_eq!(image(machines, second), drawn, "as it was");
}

fn texture(random: &mut Random) -> Image {
    let values: Vec<[u32; 4]> = (0..64).map(|_| bits([0; 4].map(|_| random.between(0.0, 1.0)))).collect();
    image(TexelFormat::Rgba8, [8; 2], &values)
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
