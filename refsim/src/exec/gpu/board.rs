//! GPU memory of an emulated card: one buffer for textures, targets and depth buffers, and the buffers of a draw.

use super::arena::Arena;
use super::{Access, Buffer, Gpu, GpuError, Pipeline};
use std::sync::Arc;

/// Bindings of the kernels: draw, set-ups, tiles, samplers, video memory, code, scratch, counts.
pub const BINDINGS: [Access; 8] = {
    use Access::{Read, ReadWrite};
    [Read, Read, Read, Read, ReadWrite, Read, ReadWrite, ReadWrite]
};

/// Initial size of `video`, in words.
const FIRST_WORDS: usize = 1 << 16;

/// A buffer that is reallocated to grow.
#[derive(Debug)]
struct GrowableBuffer {
    buffer: Buffer,
}

impl GrowableBuffer {
    fn new(gpu: &Gpu, words: usize) -> Result<Self, GpuError> {
        Ok(Self { buffer: gpu.buffer(words)? })
    }

    /// Reallocates the buffer unless it has at least `words` words; the contents are then undefined.
    fn reserve(&mut self, gpu: &Gpu, words: usize) -> Result<&Buffer, GpuError> {
        if self.buffer.words() < words {
            self.buffer = gpu.buffer(words.next_power_of_two().min(gpu.most_words().max(words)))?;
        }
        Ok(&self.buffer)
    }

    fn fill(&mut self, gpu: &Gpu, words: &[u32]) -> Result<(), GpuError> {
        let buffer = self.reserve(gpu, words.len())?;
        gpu.upload(buffer, 0, words)
    }
}

/// The GPU buffers of a card.
#[derive(Debug)]
pub struct Board {
    gpu: Arc<Gpu>,
    video: GrowableBuffer,
    arena: Arena,
    draw: GrowableBuffer,
    setups: GrowableBuffer,
    tiles: GrowableBuffer,
    samplers: GrowableBuffer,
    code: GrowableBuffer,
    scratch: GrowableBuffer,
    counts: GrowableBuffer,
}

/// The pixel program of a draw, loaded on the GPU.
#[derive(Clone, Debug)]
pub struct LoadedProgram {
    /// The kernel that executes it.
    pub pipeline: Pipeline,
    /// Contents of the binding `code`.
    pub code: Vec<u32>,
    /// Register rows per invocation in `scratch`.
    pub registers: usize,
}

impl Board {
    /// Creates an empty board.
    ///
    /// # Errors
    /// [`GpuError::Memory`].
    pub fn new(gpu: Arc<Gpu>) -> Result<Self, GpuError> {
        let one = |words| GrowableBuffer::new(&gpu, words);
        Ok(Self {
            video: one(FIRST_WORDS)?,
            arena: Arena::default(),
            draw: one(1024)?,
            setups: one(1 << 16)?,
            tiles: one(1 << 14)?,
            samplers: one(1024)?,
            code: one(4096)?,
            scratch: one(1 << 16)?,
            counts: one(64)?,
            gpu,
        })
    }

    /// The GPU.
    pub fn gpu(&self) -> &Arc<Gpu> {
        &self.gpu
    }

    /// Allocates words in `video`; returns the first word's index.
    ///
    /// # Errors
    /// [`GpuError::Memory`].
    pub fn allocate(&mut self, words: usize) -> Result<usize, GpuError> {
        let base = self.arena.take(words);
        let end = self.arena.end;
        if end > self.video.buffer.words() {
            let size = end.next_power_of_two().min(self.gpu.most_words().max(end));
            let larger = self.gpu.buffer(size)?;
            self.gpu.copy(&self.video.buffer, &larger);
            self.video.buffer = larger;
        }
        Ok(base)
    }

    /// Frees words in `video`.
    pub fn free(&mut self, base: usize, words: usize) {
        self.arena.give(base, words);
    }

    /// Writes words into `video`.
    ///
    /// # Errors
    /// [`GpuError::Device`].
    pub fn write(&self, base: usize, words: &[u32]) -> Result<(), GpuError> {
        self.gpu.upload(&self.video.buffer, base, words)
    }

    /// Reads words from `video`, after all previously submitted work.
    ///
    /// # Errors
    /// [`GpuError::Device`].
    pub fn read(&self, base: usize, words: usize) -> Result<Vec<u32>, GpuError> {
        self.gpu.read(&self.video.buffer, base..base + words)
    }

    /// Starts a draw: uploads its program and samplers, and clears the counts.
    ///
    /// # Errors
    /// [`GpuError::Memory`], [`GpuError::Device`].
    pub fn start(&mut self, program: &LoadedProgram, samplers: &[u32], counts: usize) -> Result<(), GpuError> {
        self.code.fill(&self.gpu, &program.code)?;
        self.samplers.fill(&self.gpu, samplers)?;
        self.counts.fill(&self.gpu, &vec![0; counts])
    }

    /// Uploads the set-ups for the next dispatches.
    ///
    /// # Errors
    /// [`GpuError::Memory`], [`GpuError::Device`].
    pub fn set_setups(&mut self, words: &[u32]) -> Result<(), GpuError> {
        self.setups.fill(&self.gpu, words)
    }

    /// Dispatches `groups` workgroups with `rows` rows of four words in `scratch`. The contents of `scratch` persist
    /// between dispatches with the same number of rows.
    ///
    /// # Errors
    /// [`GpuError::Memory`], [`GpuError::Device`].
    pub fn dispatch(
        &mut self,
        program: &LoadedProgram,
        draw: &[u32],
        tiles: &[u32],
        groups: [u32; 3],
        rows: usize,
    ) -> Result<(), GpuError> {
        let gpu = &self.gpu;
        self.draw.fill(gpu, draw)?;
        self.tiles.fill(gpu, tiles)?;
        self.scratch.reserve(gpu, 4 * rows)?;
        let buffers = [
            &self.draw,
            &self.setups,
            &self.tiles,
            &self.samplers,
            &self.video,
            &self.code,
            &self.scratch,
            &self.counts,
        ];
        gpu.dispatch(&program.pipeline, &buffers.map(|b| &b.buffer), groups)
    }

    /// Reads one word of the counts and resets it to zero.
    ///
    /// # Errors
    /// [`GpuError::Device`].
    pub fn take_count(&self, word: usize) -> Result<u32, GpuError> {
        let found = self.gpu.read(&self.counts.buffer, word..word + 1)?.first().copied().unwrap_or(0);
        if found != 0 {
            self.gpu.upload(&self.counts.buffer, word, &[0])?;
        }
        Ok(found)
    }

    /// Reads the counts of the draw, after all dispatches.
    ///
    /// # Errors
    /// [`GpuError::Device`].
    pub fn counts(&self, words: usize) -> Result<Vec<u32>, GpuError> {
        self.gpu.read(&self.counts.buffer, 0..words)
    }
}
