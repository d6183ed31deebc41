//! Golden clocks: the cost of every kernel on every card that runs it. Changed figures and formulas fail here first.

use crate::pages::hold;
use crossbar::ray_engine::kernels;
use refsim::asm::assemble;
use refsim::check::check;
use refsim::device::Profile;
use refsim::event::{DrawRecord, Event};
use refsim::exec::{CheckedProgram, Constants};
use refsim::isa::Stage;
use refsim::machine::{
    AttributeStream, DrawCall, ExecutorKind, Machine, StepRate, TextureId, VertexSource, VertexStreams,
};
use refsim::output::{AlphaTest, CompareFunction, DepthFormat, DepthState};
use refsim::raster::{PixelCenter, Primitive, Vertex};
use refsim::texture::{Image, SamplerState, TexelFormat};
use refsim::timing::cache::TextureCaches;
use refsim::timing::{Level, Model};
use std::fmt::Write as _;
use std::path::Path;

/// Side of the target and of the textures.
const SIDE: u32 = 64;
/// Quads of the draw.
const QUADS: usize = 3;

/// A quad over the screen with coordinates from 0 to 1 in every attribute that kernels read.
fn corners() -> [[f32; 4]; 4] {
    [[-1.0, 1.0, 0.0, 0.0], [1.0, 1.0, 1.0, 0.0], [1.0, -1.0, 1.0, 1.0], [-1.0, -1.0, 0.0, 1.0]]
}

fn machine(profile: &Profile) -> Machine {
    let mut machine = Machine::new(profile.clone(), ExecutorKind::Batch);
    machine.record(true);
    machine.observe_textures(Some(Box::new(TextureCaches::new(profile).expect("cards have caches"))));
    machine
}

/// The first of some formats that the device has.
fn format(profile: &Profile, wanted: &[TexelFormat]) -> TexelFormat {
    *wanted.iter().find(|format| profile.limits.texture_formats.contains(format)).expect("a format of the card")
}

/// The state of every draw: depth tested and written, alpha tested.
fn finish(mut call: DrawCall<'_>, machine: &mut Machine) -> DrawRecord {
    call.center = PixelCenter::OpenGl;
    call.alpha_test = Some(AlphaTest { function: CompareFunction::GreaterEqual, reference: 0 });
    call.depth = DepthState { test: Some(CompareFunction::LessEqual), write: true };
    call.depth_buffer = Some(machine.create_depth(DepthFormat::Unorm24, SIDE, SIDE).expect("a depth buffer"));
    machine.draw(&call).expect("the draw is made");
    let draws = machine.take_log().into_iter().filter_map(|e| if let Event::Draw(d) = e { Some(*d) } else { None });
    draws.last().expect("a draw in the log")
}

fn target(machine: &mut Machine) -> TextureId {
    machine.create_target(TexelFormat::Bgra8, SIDE, SIDE).expect("a target")
}

/// A pixel kernel over some screen-filling quads, all textures bound.
fn pixel(profile: &Profile, program: &CheckedProgram) -> DrawRecord {
    let mut machine = machine(profile);
    let kind: &[TexelFormat] = match program.version.is_ps_2() {
        true => &[TexelFormat::Rgba32f, TexelFormat::Rgba16f],
        false => &[TexelFormat::Rg16, TexelFormat::Rgba8],
    };
    let format = format(profile, kind);
    let image = || Image::new_2d(format, SIDE, SIDE).expect("an image");
    let textures: Vec<_> = (0..6).map(|_| machine.create_texture(image()).expect("a texture")).collect();
    let vertex = |[x, y, u, v]: [f32; 4]| Vertex {
        position: [x, y, 0.5, 1.0].map(f32::to_bits),
        texcoords: [[u, v, 0.25, 1.0].map(f32::to_bits); 8],
        colors: [[0.25, 0.5, 0.75, 1.0].map(f32::to_bits); 2],
        ..Vertex::default()
    };
    let vertices = corners().map(vertex).repeat(QUADS);
    let (host, target) = (Constants::default(), target(&mut machine));
    let mut call = DrawCall::new(VertexSource::Transformed(&vertices), Primitive::QuadList, program, &host, target);
    for (sampler, &texture) in textures.iter().enumerate() {
        call = call.with_texture(sampler, texture, SamplerState::NEAREST_CLAMP);
    }
    finish(call, &mut machine)
}

/// A vertex kernel that draws as many quads, with a minimal pixel program.
fn vertex(profile: &Profile, program: &CheckedProgram) -> DrawRecord {
    let mut machine = machine(profile);
    let plain = check(assemble(kernels::ID.text).expect("assembles"), profile).expect("every card runs it");
    let quad = corners().map(|c| c.map(f32::to_bits));
    let triangles = [[0.25, 0.5, 0.75, 1.0].map(f32::to_bits); QUADS];
    let stream = |register, step, data| AttributeStream { register, step, data };
    let mut streams = vec![stream(0, StepRate::Vertex, &quad[..])];
    streams.extend((1..=5).map(|register| stream(register, StepRate::Instance, &triangles[..])));
    let streams = VertexStreams { vertex_count: 4, instance_count: QUADS, streams };
    let constants = Constants { float: vec![[1.0_f32.to_bits(); 4]; 8], ..Constants::default() };
    let (host, target) = (Constants::default(), target(&mut machine));
    let source = VertexSource::Program { program, constants: &constants, streams };
    finish(DrawCall::new(source, Primitive::QuadList, &plain, &host, target), &mut machine)
}

/// The line of one kernel on one card.
fn line(name: &str, profile: &Profile, program: &CheckedProgram) -> String {
    let model = Model::new(Level::Pipeline, profile).expect("cards have time");
    let mut out = format!("\"{name}\" = {{ ");
    let record = match program.version.stage() {
        Stage::Pixel => {
            let record = pixel(profile, program);
            let fragment = model.clocks(&record);
            let one = model.fragment(&record.pixel);
            let registers = f64::from(record.pixel.live_halves) / 2.0;
            write!(out, "arithmetic = {}, textures = {}, registers = {registers}, ", one.arithmetic.0, one.textures.0)
                .expect("text");
            assert_eq!(fragment.takes_turns, one.takes_turns);
            record
        }
        Stage::Vertex => {
            let record = vertex(profile, program);
            let work = record.vertex.as_ref().expect("a vertex program ran");
            write!(out, "vertex = {}, ", model.vertex(work).0).expect("text");
            record
        }
    };
    let clocks = model.clocks(&record);
    let traffic = clocks.traffic;
    write!(
        out,
        "quads = {}, clocks = {}, bytes = {}, misses = {} }}",
        record.quads,
        clocks.total().0,
        traffic.total(),
        traffic.misses
    )
    .expect("text");
    out
}

/// The whole file.
fn all() -> String {
    let mut out = format!(
        "# Clocks of every kernel on every card that runs it: a fragment (arithmetic, texture issue, fp32 registers live) or a vertex;\n\
         # then a draw of {QUADS} screen-filling quads over {SIDE} x {SIDE} pixels: quads of pixels shaded, core clocks, bytes of memory, cache misses.\n\
         # A change is accepted with INSTA_UPDATE=always cargo test --test oracle golden_clocks\n"
    );
    for device in Profile::card_names() {
        let profile = Profile::named(device).expect("a card");
        write!(out, "\n[{device}]\n").expect("text");
        for kernel in kernels::ALL {
            let program = assemble(kernel.text).expect("kernels assemble");
            if let Ok(program) = check(program, &profile) {
                writeln!(out, "{}", line(kernel.name, &profile, &program)).expect("text");
            }
        }
    }
    out
}

#[test]
fn golden_clocks() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/timing/cycles.toml");
    let found = all();
    let parsed: toml::Table = found.parse().expect("what is stored is TOML");
    assert_eq!(parsed.len(), Profile::card_names().len());
    hold(&path, &found);
}
