//! The emulated card: memory, state, draws and read-back.
//!
//! A [`Machine`] consists of a device profile, an executor and memory. Textures and depth buffers are owned by the
//! machine and referred to by handles; a colour target is a texture. [`Machine::draw`] validates a [`DrawCall`], sets
//! up triangles in order, and shades the target in tiles of 16x16 pixels, in parallel. Bits and counts do not depend on
//! the number of threads, and one call with N instances equals N calls.
//!
//! Invalid calls return a [`MachineError`] before anything is written. Reading a texture that the same call draws into
//! is an error.

#[cfg(feature = "wgpu")]
mod device;
mod draw;
mod error;
mod executor;
mod executor_kind;
mod handle;
mod memory;
mod mipmaps;
mod observe;
mod pixel_state;
mod record;
mod recorder;
mod resources;
mod state;
mod tiles;
mod trace;
mod trace_buffers;
mod trace_layout;
mod validate;
mod vertices;
mod walk;

pub use draw::{AttributeStream, BoundTexture, DEFAULT_ATTRIBUTE, DrawCall, StepRate, VertexSource, VertexStreams};
pub use error::{MachineError, ProgramPlace};
pub use executor::Executor;
pub use executor_kind::ExecutorKind;
pub use handle::{DepthId, TextureId};
pub use pixel_state::PixelState;
pub use trace::FragmentTrace;
pub use trace_buffers::TraceBuffers;

use std::fmt::Debug;
use std::sync::Arc;

use crate::device::Profile;
use crate::event::DrawEvents;
use crate::exec::batch::{BatchExecutor, SimdLevel};
use memory::Memory;
use recorder::Recorder;
use tiles::{executor, tile_draw};
use validate::Plan;

/// Called before and after each draw of a machine ([`Executor::watched`]): for observing draws in code that creates its
/// own machines. Watchers cannot change the machine, so values and counts are the same as without a watcher.
pub trait DrawWatcher: Debug + Send + Sync {
    /// Called before a valid draw. The targets hold the results of earlier draws, so [`Machine::trace`] can follow
    /// pixels through this draw.
    ///
    /// # Errors
    /// An error ends the draw before anything is drawn.
    fn before(&self, machine: &Machine, call: &DrawCall<'_>) -> Result<(), MachineError> {
        let _ = (machine, call);
        Ok(())
    }

    /// Called after a draw; [`Machine::read_back`] returns its targets.
    ///
    /// # Errors
    /// The draw returns this error, although it has been drawn.
    fn after(&self, machine: &Machine, call: &DrawCall<'_>) -> Result<(), MachineError> {
        let _ = (machine, call);
        Ok(())
    }
}

/// An emulated card.
#[derive(Debug)]
pub struct Machine {
    profile: Arc<Profile>,
    executor: ExecutorKind,
    batch: BatchExecutor,
    pool: Option<rayon::ThreadPool>,
    memory: Memory,
    recorder: Recorder,
    watcher: Option<Arc<dyn DrawWatcher>>,
}

impl Machine {
    /// Creates a machine with empty memory that uses the global thread pool.
    pub fn new(profile: impl Into<Arc<Profile>>, executor: ExecutorKind) -> Self {
        Self {
            profile: profile.into(),
            executor,
            batch: BatchExecutor::default(),
            pool: None,
            memory: Memory::default(),
            recorder: Recorder::default(),
            watcher: None,
        }
    }

    /// Creates a machine with its own pool of `threads` threads. The number of threads only affects the speed.
    ///
    /// # Errors
    /// [`MachineError::Threads`] if the threads cannot be started.
    pub fn with_threads(
        profile: impl Into<Arc<Profile>>,
        executor: ExecutorKind,
        threads: usize,
    ) -> Result<Self, MachineError> {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads.max(1))
            .build()
            .map_err(|e| MachineError::Threads { threads, reason: e.to_string() })?;
        Ok(Self { pool: Some(pool), ..Self::new(profile, executor) })
    }

    /// The device.
    pub fn profile(&self) -> &Profile {
        &self.profile
    }

    /// The executor.
    pub fn executor(&self) -> ExecutorKind {
        self.executor
    }

    /// Sets the SIMD level of the batch executor. `None`, the default, selects the widest level that the processor
    /// supports; an unsupported level falls back to a supported one. The level only affects the speed.
    pub fn set_simd_level(&mut self, level: Option<SimdLevel>) {
        self.batch.set_simd_level(level);
    }

    /// Executes a draw call.
    ///
    /// # Errors
    /// If the call is invalid for the machine or the device; nothing is drawn then.
    pub fn draw(&mut self, call: &DrawCall<'_>) -> Result<DrawEvents, MachineError> {
        let plan = validate::plan(&self.profile, &self.memory, call)?;
        self.watch(|watcher, machine| watcher.before(machine, call))?;
        let (events, traffic) = match &self.recorder.observer {
            Some(_) => self.shade_observed(call, &plan).map(|(events, traffic)| (events, Some(traffic)))?,
            None => (self.shade(call, &plan)?, None),
        };
        self.note_draw(call, &plan, &events, traffic.as_ref());
        self.watch(|watcher, machine| watcher.after(machine, call))?;
        Ok(events)
    }

    /// Calls the watcher; its read-backs are not logged.
    fn watch(
        &mut self,
        call: impl FnOnce(&dyn DrawWatcher, &Self) -> Result<(), MachineError>,
    ) -> Result<(), MachineError> {
        let Some(watcher) = self.watcher.clone() else { return Ok(()) };
        let is_recording = std::mem::replace(&mut self.recorder.on, false);
        let seen = call(&*watcher, self);
        self.recorder.on = is_recording;
        seen
    }

    fn shade(&mut self, call: &DrawCall<'_>, plan: &Plan) -> Result<DrawEvents, MachineError> {
        #[cfg(feature = "wgpu")]
        if self.executor == ExecutorKind::Wgpu {
            return self.draw_on_gpu(call, plan);
        }
        self.draw_on_host(self.executor, call, plan)
    }

    /// Executes a validated call on an executor of the host.
    fn draw_on_host(
        &mut self,
        executor_kind: ExecutorKind,
        call: &DrawCall<'_>,
        plan: &Plan,
    ) -> Result<DrawEvents, MachineError> {
        self.memory.name_textures(&call.samplers);
        let (memory, profile, kind) = (&self.memory, &self.profile, (executor_kind, &self.batch));
        let work = || {
            let executor = executor(kind, &tile_draw(profile, memory, call));
            walk::draw(memory, profile, call, plan, kind, &executor)
        };
        let drawn = match &self.pool {
            Some(pool) => pool.install(work),
            None => work(),
        }?;
        for tile in drawn.tiles {
            self.memory.store(&tile, &call.targets, call.depth_buffer)?;
        }
        Ok(drawn.events)
    }
}
