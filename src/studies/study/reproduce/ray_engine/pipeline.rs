//! Draws on the emulated cards, timed by the pipeline model.

use refsim::asm::assemble;
use refsim::check::check;
use refsim::device::Profile;
use refsim::event::{DrawRecord, Event};
use refsim::exec::Constants;
use refsim::machine::{DrawCall, ExecutorKind, Machine, VertexSource};
use refsim::output::{CompareFunction, DepthFormat, DepthState};
use refsim::raster::{PixelCenter, Primitive, Vertex};
use refsim::texture::{Image, SamplerState, TexelFormat};
use refsim::timing::{DrawCost, Level, Model};

use super::{RunResult, no_time};
use crate::study::StudyError;

/// Side of the screen and of its textures, in pixels. The paper does not state it; the rate hardly depends on it.
const SIDE: u32 = 256;
/// Quads per draw for measuring a fill rate: enough to make filling and draining of the pipeline negligible.
const QUADS: usize = 64;
/// Program with two textures per pixel, like ray origins and directions, and as much arithmetic as a ps_1_1 card can
/// execute in one clock.
const DUAL_TEXTURED: &str = "ps_1_1\ntex t0\ntex t1\nmul r0, t0, t1\n";

pub(super) struct TimedDraw {
    pub(super) record: DrawRecord,
    pub(super) cost: DrawCost,
}

impl TimedDraw {
    pub(super) fn pixels_per_s(&self) -> f64 {
        self.record.counts.fragments.generated as f64 / self.cost.total.seconds()
    }
}

pub(super) fn model(device: &str) -> Result<Model, StudyError> {
    Model::new(Level::Pipeline, &Profile::named(device)?).map_err(no_time)
}

/// Times the most expensive draw of a log.
pub(super) fn timed(device: &str, log: Vec<Event>) -> Result<TimedDraw, StudyError> {
    let model = model(device)?;
    let draws = log.into_iter().filter_map(|event| match event {
        Event::Draw(record) => Some(TimedDraw { cost: model.draw(&record), record: *record }),
        _ => None,
    });
    draws.max_by_key(|draw| draw.cost.total).ok_or("no draw was recorded").on(device)
}

/// Times screen-filling quads with two textures of the screen's size, with depth test and write.
pub(super) fn dual_textured(device: &str) -> Result<TimedDraw, StudyError> {
    timed(device, screen_quads(device, QUADS)?)
}

/// Results per second that read-back alone allows, with `gamma` bytes each, one screen at a time.
pub(super) fn results_per_s(device: &str, gamma: f64) -> Result<f64, StudyError> {
    let rays = f64::from(SIDE * SIDE);
    Ok(rays / model(device)?.read_back((rays * gamma) as u64).seconds())
}

/// Tests per second as in equation 11, but drawn and timed: quads for `triangles` triangles over a screen of rays, then
/// a read-back.
pub(super) fn tests_per_s(device: &str, triangles: f64, gamma: f64) -> Result<f64, StudyError> {
    let drawn = timed(device, screen_quads(device, triangles as usize)?)?;
    let rays = f64::from(SIDE * SIDE);
    let back = model(device)?.read_back((rays * gamma) as u64);
    Ok(triangles * rays / (drawn.cost.total + back).seconds())
}

/// Records the log of one draw of `quads` quads over the screen.
fn screen_quads(device: &str, quads: usize) -> Result<Vec<Event>, StudyError> {
    let profile = Profile::named(device)?;
    let program = assemble(DUAL_TEXTURED).on(device)?;
    let program = check(program, &profile).on(device)?;
    let mut machine = Machine::new(profile, ExecutorKind::Batch);
    machine.record(true);
    let draw = |machine: &mut Machine| -> Result<(), refsim::machine::MachineError> {
        let target = machine.create_target(TexelFormat::Bgra8, SIDE, SIDE)?;
        let depth = machine.create_depth(DepthFormat::Unorm24, SIDE, SIDE)?;
        let textures = [(); 2].map(|()| Image::new_2d(TexelFormat::Bgra8, SIDE, SIDE));
        let vertices: Vec<Vertex> = (0..quads).flat_map(|_| screen_quad()).collect();
        let constants = Constants::default();
        let source = VertexSource::Transformed(&vertices);
        let mut call = DrawCall::new(source, Primitive::QuadList, &program, &constants, target);
        for (stage, image) in textures.into_iter().enumerate() {
            call = call.with_texture(stage, machine.create_texture(image?)?, SamplerState::NEAREST_CLAMP);
        }
        call.center = PixelCenter::OpenGl;
        call.depth = DepthState { test: Some(CompareFunction::LessEqual), write: true };
        call.depth_buffer = Some(depth);
        machine.draw(&call)?;
        Ok(())
    };
    draw(&mut machine).on(device)?;
    Ok(machine.take_log())
}

/// Quad over the whole screen at depth 0.5; coordinate sets 0 and 1 run from 0 to 1 over it, with row 0 at the top.
fn screen_quad() -> [Vertex; 4] {
    [[-1.0f32, 1.0], [1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]].map(|[x, y]| {
        let mut vertex = Vertex { position: [x, y, 0.5, 1.0].map(f32::to_bits), ..Vertex::default() };
        for set in 0..2 {
            vertex.texcoords[set] = [0.5 + 0.5 * x, 0.5 - 0.5 * y, 0.0, 1.0].map(f32::to_bits);
        }
        vertex
    })
}
