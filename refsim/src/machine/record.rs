//! The machine's log of calls, for the timing model.
//!
//! Recording is off by default, because it takes time. It changes no value, and the log does not depend on the executor
//! or the number of threads.

use super::state::DrawState;
use super::validate::Plan;
use super::vertices::VertexStage;
use super::{DepthId, DrawCall, ExecutorKind, Machine, MachineError, TextureId, VertexSource};
use crate::event::{
    DepthRecord, DrawEvents, DrawRecord, Event, FenceId, FlowConstants, ProgramWork, ReadBackMode, ResourceId,
    SAMPLERS, SamplerRecord, SamplerTraffic, TargetRecord, vertex_cache_misses,
};
use crate::exec::batch::{Instances, Surfaces};
use crate::exec::{CheckedProgram, Constants, program};
use crate::isa::{Opcode, RegisterFile};
use crate::output::DepthSurface;
use crate::raster::{ComponentMask, Edge, RasterRules, TriangleSetup};
use crate::texture::{Image, MipFilter, Region};
use std::collections::BTreeMap;
use std::sync::{Arc, PoisonError};

/// Maximum number of cached coverages within a draw: the Ray Engine draws the same outline many times.
const MAX_OUTLINES: usize = 1024;

impl Machine {
    /// Starts or stops recording. The events recorded so far are kept.
    pub fn record(&mut self, on: bool) {
        self.recorder.on = on;
    }

    /// Returns and clears the recorded events, in order.
    pub fn take_log(&mut self) -> Vec<Event> {
        let log = self.recorder.log.get_mut().unwrap_or_else(PoisonError::into_inner);
        std::mem::take(&mut log.events)
    }

    /// Reads a texture or target back asynchronously: in the log the host continues, and the returned fence is passed
    /// when the last byte has arrived. Returns the image of [`Machine::read_back`].
    ///
    /// # Errors
    /// If the handle is invalid.
    pub fn read_back_async(&self, id: TextureId) -> Result<(FenceId, &Image), MachineError> {
        let image = self.memory.current(id)?;
        let fence = self.next_fence();
        let bytes = image.bytes().len() as u64;
        let mode = ReadBackMode::Asynchronous;
        self.recorder.push(|| Event::ReadBack { resource: id.into(), bytes, mode, fence: Some(fence) });
        Ok((fence, image))
    }

    /// [`Machine::read_back_async`] for a depth buffer.
    ///
    /// # Errors
    /// If the handle is invalid.
    pub fn read_depth_async(&self, id: DepthId) -> Result<(FenceId, &DepthSurface), MachineError> {
        let surface = self.memory.current_depth(id)?;
        let fence = self.next_fence();
        let bytes = surface.bytes();
        let mode = ReadBackMode::Asynchronous;
        self.recorder.push(|| Event::ReadBack { resource: id.into(), bytes, mode, fence: Some(fence) });
        Ok((fence, surface))
    }

    /// Records that the host waits for a fence (`FinishFenceNV`).
    pub fn finish_fence(&self, fence: FenceId) {
        self.recorder.push(|| Event::FinishFence(fence));
    }

    /// Returns a new fence number; if recording is off, the same number every time.
    fn next_fence(&self) -> FenceId {
        let number = self.recorder.with(|log| {
            log.fences = log.fences.wrapping_add(1);
            log.fences
        });
        FenceId(number.unwrap_or_default())
    }

    pub(super) fn note_read_back(&self, resource: ResourceId, bytes: u64) {
        let mode = ReadBackMode::Synchronous;
        self.recorder.push(|| Event::ReadBack { resource, bytes, mode, fence: None });
    }

    pub(super) fn note_draw(
        &self,
        call: &DrawCall<'_>,
        plan: &Plan,
        counts: &DrawEvents,
        traffic: Option<&[SamplerTraffic; SAMPLERS]>,
    ) {
        if !self.recorder.is_on() {
            return;
        }
        let record = self.draw_record(call, plan, counts, traffic);
        self.recorder.with(|log| {
            let (changes, constants) = DrawState::update(&mut log.state, call);
            if changes > 0 {
                log.events.push(Event::StateChange { changes, constants });
            }
            log.events.push(Event::Draw(Box::new(record)));
        });
    }

    fn draw_record(
        &self,
        call: &DrawCall<'_>,
        plan: &Plan,
        counts: &DrawEvents,
        traffic: Option<&[SamplerTraffic; SAMPLERS]>,
    ) -> DrawRecord {
        let vertex = match &call.vertices {
            VertexSource::Transformed(_) => None,
            VertexSource::Program { program, constants, .. } => Some(Arc::new(work(program, constants))),
        };
        DrawRecord {
            counts: *counts,
            vertices_run: vertices_run(call, counts, self.profile.rates.vertex_cache_entries),
            quads: self.quads(call, plan),
            pixel: Arc::new(work(call.pixel_program, call.pixel_constants)),
            vertex,
            samplers: self.samplers(call, traffic),
            targets: self.targets(call),
            depth: call.depth_buffer.and_then(|id| self.depth_record(call, id)),
            alpha_test: call.alpha_test.is_some(),
            blend: call.blend.is_some(),
        }
    }

    fn samplers(&self, call: &DrawCall<'_>, traffic: Option<&[SamplerTraffic; SAMPLERS]>) -> Vec<SamplerRecord> {
        let mut out = Vec::new();
        for (sampler, bound) in (0_u8..).zip(&call.samplers) {
            let Some((bound, image)) = bound.and_then(|b| Some((b, self.memory.texture(b.texture).ok()?))) else {
                continue;
            };
            out.push(SamplerRecord {
                sampler,
                texture: bound.texture.into(),
                texel_bytes: image.format().bytes() as u32,
                texture_bytes: image.bytes().len() as u64,
                trilinear: image.levels().len() > 1 && bound.state.mip == MipFilter::Linear,
                traffic: traffic.and_then(|all| all.get(usize::from(sampler)).copied()),
            });
        }
        out
    }

    fn targets(&self, call: &DrawCall<'_>) -> Vec<TargetRecord> {
        let named = crate::exec::colors_written(program(call.pixel_program));
        let mut out = Vec::new();
        for (i, (&id, mask)) in call.targets.iter().zip(call.masks).enumerate() {
            let Ok(image) = self.memory.texture(id) else { continue };
            let stored = image.format().record().stored();
            let wanted = stored.iter().filter(|c| mask.has(c.stored_from)).count();
            let written = named >> i & 1 == 1 && wanted > 0;
            let read = written && (call.blend.is_some() || wanted < stored.len());
            out.push(TargetRecord { target: id.into(), pixel_bytes: image.format().bytes() as u32, written, read });
        }
        out
    }

    fn depth_record(&self, call: &DrawCall<'_>, id: DepthId) -> Option<DepthRecord> {
        let surface = self.memory.depth(id).ok()?;
        let code = &program(call.pixel_program).instructions;
        let replaced = code.iter().any(|i| {
            matches!(i.opcode, Opcode::TexDepth | Opcode::TexM3x2Depth)
                || i.destination.is_some_and(|d| d.register.file == RegisterFile::DepthOut)
        });
        Some(DepthRecord {
            buffer: id.into(),
            pixel_bytes: surface.format().bytes() as u32,
            test: call.depth.test.is_some(),
            write: call.depth.test.is_some() && call.depth.write,
            replaced,
        })
    }

    /// Number of quads that ran the pixel program, computed by repeating the triangle set-up in rows.
    fn quads(&self, call: &DrawCall<'_>, plan: &Plan) -> u64 {
        let needed = ComponentMask::NONE;
        let stage = VertexStage::new(call, &self.profile, (ExecutorKind::Batch, &self.batch), needed);
        let rules = RasterRules::from(&self.profile.rules);
        let mut outlines = BTreeMap::new();
        let mut quads = 0;
        for round in plan.rounds() {
            let (first, count) = (round.start, round.len());
            // The draw has succeeded, so no vertex exceeds the step budget.
            let Ok(rows) = stage.rows(first, count, plan, needed) else { break };
            let instances = Instances { rows: &rows, count, triangles: &plan.triangles };
            let (surfaces, _) = Surfaces::build(&instances, &plan.raster, &rules, needed, self.batch.simd());
            let shapes = (0..surfaces.len()).filter_map(|triangle| surfaces.geometry(triangle));
            quads += shapes.map(|shape| covered(shape, &mut outlines)).sum::<u64>();
        }
        quads
    }
}

/// Number of vertices that the vertex program processes, with vertex caches of half, one and two times `entries`.
fn vertices_run(call: &DrawCall<'_>, counts: &DrawEvents, entries: Option<u64>) -> [u64; 3] {
    let (Some(indices), Some(entries)) = (call.indices, entries) else { return [counts.vertices; 3] };
    let vertices = match &call.vertices {
        VertexSource::Transformed(vertices) => vertices.len(),
        VertexSource::Program { streams, .. } => streams.vertex_count,
    };
    let of = |entries| counts.instances.saturating_mul(vertex_cache_misses(indices, vertices, entries));
    [entries / 2, entries, entries.saturating_mul(2)].map(of)
}

/// An outline: edges and bounding box.
type Outline = ([(i64, i64, i64, i64); 3], (u32, u32, u32, u32));

fn covered(setup: &TriangleSetup, outlines: &mut BTreeMap<Outline, u64>) -> u64 {
    let edge = |e: &Edge| (e.a, e.b, e.c, e.bias);
    let Region { x, y, width, height } = setup.bounds;
    let outline = (setup.edges.each_ref().map(edge), (x, y, width, height));
    if let Some(&known) = outlines.get(&outline) {
        return known;
    }
    let quads = setup.quads(setup.bounds).count() as u64;
    if outlines.len() < MAX_OUTLINES {
        outlines.insert(outline, quads);
    }
    quads
}

fn work(checked: &CheckedProgram, constants: &Constants) -> ProgramWork {
    ProgramWork::new(program(checked), FlowConstants { int: &constants.int, boolean: &constants.boolean })
}
