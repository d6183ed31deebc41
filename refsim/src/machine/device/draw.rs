//! Draws on the GPU: vertices, assembly and set-up on the host, then the kernel over the tiles.

use super::shader::load;
use super::{Card, batches};
use crate::device::Profile;
use crate::event::{DrawEvents, FragmentCounts};
use crate::exec::batch::BatchExecutor;
use crate::exec::budget::{enforced, straight_exceeds};
use crate::exec::gpu::{AdapterKind, Gpu, GpuError, LoadedProgram};
use crate::exec::wgsl::kernel::{
    COUNT_WORDS, CUT, DepthPlace, DrawDispatch, DrawWords, EXTRA_ROWS, INVOCATIONS, UNFINISHED,
};
use crate::exec::wgsl::program::supports;
use crate::exec::wgsl::target::TargetPlace;
use crate::exec::{FlowMap, ResolvedConstants, inputs_read, program};
use crate::isa::Stage;
use crate::machine::memory::Memory;
use crate::machine::trace_layout::draw_words;
use crate::machine::validate::Plan;
use crate::machine::validate::ROUND;
use crate::machine::vertices::{VertexStage, set_up};
use crate::machine::walk::bytes;
use crate::machine::{DrawCall, ExecutorKind, Machine, MachineError, VertexSource};
use crate::output::MAX_TARGETS;
use crate::raster::TriangleSetup;
use std::sync::Arc;

/// Maximum number of triangles per dispatch, counted once per tile, so that no dispatch runs for seconds.
const MAX_TRIANGLES: usize = 8192;
/// Maximum number of tiles per dispatch.
const MAX_TILES: usize = 4096;
/// Maximum number of loop iterations per invocation and dispatch. On software adapters it is a quarter of lavapipe's
/// limit, 65,535, because divergent lanes add up. These are loops of the shader, independent of the program's step
/// budget.
const SOFTWARE_PASSES: u32 = 16_000;
const PASSES: u32 = 1 << 22;
/// Workgroups per row of a dispatch; WebGPU's limit is 65,535.
const ROW: usize = 256;

impl Machine {
    /// Creates a machine that draws on a GPU. The bits are the same on every GPU.
    ///
    /// # Errors
    /// [`MachineError::Gpu`] if the GPU has no memory for it.
    pub fn with_gpu(profile: impl Into<Arc<Profile>>, gpu: Arc<Gpu>) -> Result<Self, MachineError> {
        let mut machine = Self::new(profile, ExecutorKind::Wgpu);
        machine.memory.card = Some(Card::new(gpu)?);
        Ok(machine)
    }

    /// Executes a validated call on the given GPU, or on the best adapter of the host.
    ///
    /// The batch executor draws with the pixel programs that shaders do not run, or that exceed the step budget.
    pub(in crate::machine) fn draw_on_gpu(
        &mut self,
        call: &DrawCall<'_>,
        plan: &Plan,
    ) -> Result<DrawEvents, MachineError> {
        let budget = self.profile.limits.step_budget(Stage::Pixel);
        let fits = !straight_exceeds(program(call.pixel_program), budget);
        if !(fits && supports(call.pixel_program, &self.profile.rules)) {
            self.memory.download_newer(&call.targets, call.depth_buffer)?;
            return self.draw_on_host(ExecutorKind::Batch, call, plan);
        }
        let may_fail = self.vertices_may_fail(call);
        if may_fail {
            self.memory.download_newer(&call.targets, call.depth_buffer)?;
        }
        let mut card = match self.memory.card.take() {
            Some(card) => card,
            None => Card::new(Arc::new(Gpu::open(None)?))?,
        };
        let drawn = card.draw((&self.memory, &self.profile), &self.batch, call, plan);
        self.memory.card = Some(card);
        if drawn.is_err() && may_fail {
            self.memory.discard_gpu_contents(&call.targets, call.depth_buffer)?;
        }
        drawn
    }

    fn vertices_may_fail(&self, call: &DrawCall<'_>) -> bool {
        let VertexSource::Program { program: source, constants, .. } = &call.vertices else { return false };
        let constants = ResolvedConstants::vertex(source, &self.profile.rules, constants);
        let budget = self.profile.limits.step_budget(Stage::Vertex);
        enforced(source, &FlowMap::new(source), &constants, budget).is_some()
    }
}

impl Card {
    fn draw(
        &mut self,
        (memory, profile): (&Memory, &Profile),
        batch: &BatchExecutor,
        call: &DrawCall<'_>,
        plan: &Plan,
    ) -> Result<DrawEvents, MachineError> {
        let needed = inputs_read(program(call.pixel_program));
        let stage = VertexStage::new(call, profile, (ExecutorKind::Batch, batch), needed);
        let mut events = DrawEvents { draws: 1, instances: plan.instance_count as u64, ..DrawEvents::default() };
        let mut words = self.place(memory, profile, call)?;
        let (program, samplers) = load(self, memory, profile, call, &mut words)?;
        self.board.start(&program, &samplers, COUNT_WORDS)?;
        let round = (ROUND / plan.triangles.len().max(1)).max(1);
        let mut first = 0;
        while first < plan.instance_count {
            let count = round.min(plan.instance_count - first);
            let batch = stage.run(first, count, plan)?;
            events.vertices += batch.vertices.len() as u64;
            events.vertex_instructions += batch.slots;
            let (setups, primitives) = set_up(&batch.vertices, count, plan, profile);
            events.primitives += primitives;
            for part in setups.chunks(ROUND) {
                self.shade(&mut words, &program, part, plan)?;
            }
            first += count;
        }
        events.fragments = counts(&self.uncut()?);
        events.bytes = bytes(memory, call, &stage, &events);
        Ok(events)
    }

    /// Reads the counts; returns an error if the driver terminated a loop.
    fn uncut(&self) -> Result<Vec<u32>, MachineError> {
        let found = self.board.counts(COUNT_WORDS)?;
        if found.get(CUT).is_some_and(|&n| n != 0) {
            let adapter = self.board.gpu().adapter().name.clone();
            let reason = "its driver ends long loops early; use another adapter or executor".to_owned();
            return Err(GpuError::Device { adapter, reason }.into());
        }
        Ok(found)
    }

    /// Ensures that targets are on the GPU; returns the draw parameters of the kernel.
    fn place(&mut self, memory: &Memory, profile: &Profile, call: &DrawCall<'_>) -> Result<DrawWords, MachineError> {
        let mut targets = [None; MAX_TARGETS];
        for (slot, &id) in targets.iter_mut().zip(&call.targets) {
            let image = memory.texture(id)?;
            let base = self.place_texture(id.0, image)? as u32;
            *slot = Some(TargetPlace { format: image.format(), base, width: image.width() });
            if let Some(held) = self.textures.get_mut(&id.0) {
                held.drawn_into();
            }
        }
        let mut depth = None;
        if let Some(id) = call.depth_buffer {
            let surface = memory.depth(id)?;
            let base = self.place_depth(id.0, surface)? as u32;
            depth = Some(DepthPlace { format: surface.format(), base, width: surface.width() });
            if let Some(held) = self.depths.get_mut(&id.0) {
                held.drawn_into();
            }
        }
        Ok(draw_words(profile, call, targets, depth))
    }

    /// Draws a group of triangles into the tiles.
    fn shade(
        &mut self,
        words: &mut DrawWords,
        program: &LoadedProgram,
        setups: &[TriangleSetup],
        plan: &Plan,
    ) -> Result<(), MachineError> {
        let mut packed = Vec::with_capacity(setups.len() * words.setup_words());
        setups.iter().for_each(|setup| words.setup(setup, &mut packed));
        self.board.set_setups(&packed)?;
        let fit = self.board.gpu().most_words() / (4 * INVOCATIONS * (program.registers + EXTRA_ROWS));
        let dispatches = batches::dispatches(setups, plan.raster.scissor, MAX_TILES.min(fit), MAX_TRIANGLES);
        for part in dispatches {
            self.dispatch(words, program, &part)?;
        }
        Ok(())
    }

    /// Repeats a dispatch until all its invocations have finished.
    fn dispatch(
        &mut self,
        words: &mut DrawWords,
        program: &LoadedProgram,
        part: &batches::TileBatch,
    ) -> Result<(), MachineError> {
        let columns = part.tiles.min(ROW);
        let groups = [columns as u32, part.tiles.div_ceil(ROW) as u32, 1];
        let passes = passes(self.board.gpu());
        let registers = program.registers;
        let mut dispatch = DrawDispatch { tiles: part.tiles, groups: columns, registers, resumes: false, passes };
        loop {
            let draw = words.dispatch(&dispatch);
            let invocations = part.tiles * INVOCATIONS;
            self.board.dispatch(program, draw, &part.words, groups, (registers + EXTRA_ROWS) * invocations)?;
            if self.board.take_count(UNFINISHED)? == 0 {
                return Ok(());
            }
            dispatch.resumes = true;
        }
    }
}

/// Maximum loop iterations per invocation and dispatch.
fn passes(gpu: &Gpu) -> u32 {
    match gpu.adapter().kind {
        AdapterKind::Software => SOFTWARE_PASSES,
        _ => PASSES,
    }
}

fn counts(words: &[u32]) -> FragmentCounts {
    let of = |k: usize| match words.get(2 * k..2 * k + 2) {
        Some(&[low, high]) => u64::from(high) << 32 | u64::from(low),
        _ => 0,
    };
    FragmentCounts {
        generated: of(0),
        shaded: of(0),
        killed: of(2),
        alpha_failed: of(3),
        depth_failed: of(4),
        passed: of(5),
        fetches: std::array::from_fn(|i| of(6 + i)),
    }
}
