//! Batches of rays through the crossbar of a ps_1_1 card: quads with two textures, as the paper measured its fill rate.

use crossbar::study::reproduce::{DUAL_TEXTURED, screen_quad};
use refsim::asm::assemble;
use refsim::check::check;
use refsim::device::Profile;
use refsim::event::{Event, ReadBackMode};
use refsim::exec::{CheckedProgram, Constants};
use refsim::machine::{DrawCall, ExecutorKind, Machine, VertexSource};
use refsim::output::{CompareFunction, DepthFormat, DepthState};
use refsim::raster::{PixelCenter, Primitive, Vertex};
use refsim::texture::{Image, SamplerState, TexelFormat};
use refsim::timing::cache::TextureCaches;

/// Rows per bucket: the paper's textures are 64 x 4.
const ROWS: u32 = 4;

/// A run: several batches in sequence.
#[derive(Clone, Copy)]
pub(crate) struct Batches {
    pub(crate) device: &'static str,
    /// Rays per batch; a multiple of 4.
    pub(crate) rays: u32,
    /// Triangles tested per ray.
    pub(crate) triangles: usize,
    /// Number of batches.
    pub(crate) batches: usize,
    /// Bytes per result: 1, 2, 4 or 16.
    pub(crate) read_back_bytes: u32,
    /// Synchronous: the host waits for each batch; asynchronous: it waits for the previous one.
    pub(crate) mode: ReadBackMode,
    /// `true` to simulate the texture cache.
    pub(crate) observed: bool,
}

impl Batches {
    /// One batch of 256 rays and ten triangles, with ids of four bytes.
    pub(crate) fn new(device: &'static str) -> Self {
        Self {
            device,
            rays: 256,
            triangles: 10,
            batches: 1,
            read_back_bytes: 4,
            mode: ReadBackMode::Synchronous,
            observed: false,
        }
    }

    /// Number of ray-triangle tests of the run.
    pub(crate) fn tests(&self) -> u64 {
        u64::from(self.rays) * self.triangles as u64 * self.batches as u64
    }

    /// Records the run.
    pub(crate) fn log(&self) -> Vec<Event> {
        let profile = Profile::named(self.device).expect("a card of the project");
        let program = assemble(DUAL_TEXTURED).expect("it assembles");
        let program = check(program, &profile).expect("the card takes it");
        let caches = self.observed.then(|| TextureCaches::new(&profile).expect("the card has a cache"));
        let mut machine = Machine::new(profile, ExecutorKind::Batch);
        if let Some(caches) = caches {
            machine.observe_textures(Some(Box::new(caches)));
        }
        machine.record(true);
        let mut before = None;
        for _ in 0..self.batches {
            let fence = self.batch(&mut machine, &program);
            if let Some(fence) = std::mem::replace(&mut before, fence) {
                machine.finish_fence(fence);
            }
        }
        if let Some(fence) = before {
            machine.finish_fence(fence);
        }
        machine.take_log().into_iter().map(|event| self.narrowed(event)).collect()
    }

    /// Uploads rays, draws quads over them, and reads results back.
    fn batch(&self, machine: &mut Machine, program: &CheckedProgram) -> Option<refsim::event::FenceId> {
        let (width, height) = (self.rays / ROWS, ROWS);
        let target = machine.create_target(TexelFormat::Bgra8, width, height).expect("a target");
        let depth = machine.create_depth(DepthFormat::Unorm24, width, height).expect("a depth buffer");
        let vertices: Vec<Vertex> = (0..self.triangles).flat_map(|_| screen_quad()).collect();
        let constants = Constants::default();
        let mut call =
            DrawCall::new(VertexSource::Transformed(&vertices), Primitive::QuadList, program, &constants, target);
        for stage in 0..2 {
            let image = Image::new_2d(TexelFormat::Bgra8, width, height).expect("a texture of a bucket's size");
            let texture = machine.create_texture(image).expect("the card has the format");
            call = call.with_texture(stage, texture, SamplerState::NEAREST_CLAMP);
        }
        call.center = PixelCenter::OpenGl;
        call.depth = DepthState { test: Some(CompareFunction::LessEqual), write: true };
        call.depth_buffer = Some(depth);
        machine.draw(&call).expect("the card draws");
        match self.mode {
            ReadBackMode::Synchronous => {
                machine.read_back(target).expect("a live target");
                None
            }
            ReadBackMode::Asynchronous => Some(machine.read_back_async(target).expect("a live target").0),
        }
    }

    /// Changes the bytes of a read-back: targets have four bytes per pixel, results may have another width.
    fn narrowed(&self, event: Event) -> Event {
        match event {
            Event::ReadBack { resource, mode, fence, .. } => {
                let bytes = u64::from(self.rays) * u64::from(self.read_back_bytes);
                Event::ReadBack { resource, bytes, mode, fence }
            }
            other => other,
        }
    }
}

/// A log with the same draws and a cache that never hits.
pub(crate) fn without_cache(mut log: Vec<Event>) -> Vec<Event> {
    for event in &mut log {
        let Event::Draw(record) = event else { continue };
        for traffic in record.samplers.iter_mut().filter_map(|sampler| sampler.traffic.as_mut()) {
            traffic.misses = [traffic.accesses; 3];
        }
    }
    log
}
