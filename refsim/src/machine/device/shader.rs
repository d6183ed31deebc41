//! The pixel program of a draw, encoded for the GPU.

use super::Card;
use crate::device::Profile;
use crate::exec::gpu::{BINDINGS, Gpu, Kernel, LoadedProgram};
use crate::exec::wgsl::kernel::DrawWords;
use crate::exec::wgsl::{follow, kernel, program, texture};
use crate::machine::memory::Memory;
use crate::machine::trace_layout::{EncodedProgram, VideoMemory};
use crate::machine::{DrawCall, MachineError};
use crate::texture::Image;

pub(super) const DRAW: Kernel = Kernel {
    entry: kernel::ENTRY,
    text: || kernel::text() + &program::machine() + program::NO_TRACE + &texture::library(),
    bindings: &BINDINGS,
};

/// Kernel that traces pixels.
pub(super) const FOLLOW: Kernel = Kernel { entry: follow::ENTRY, text: follow::module, bindings: &BINDINGS };

impl VideoMemory for Card {
    fn allocate(&mut self, words: usize) -> Result<usize, MachineError> {
        Ok(self.board.allocate(words)?)
    }

    fn place_texture(&mut self, number: usize, image: &Image) -> Result<usize, MachineError> {
        Ok(Self::place_texture(self, number, image)?)
    }
}

/// Encodes and uploads the program and the samplers of a draw, and the textures they read.
pub(super) fn load(
    card: &mut Card,
    memory: &Memory,
    profile: &Profile,
    call: &DrawCall<'_>,
    words: &mut DrawWords,
    kernel: &Kernel,
) -> Result<(LoadedProgram, Vec<u32>), MachineError> {
    let encoded = EncodedProgram::new(card, memory, profile, call, words, false)?;
    encoded.load(card.board.gpu(), kernel)
}

impl EncodedProgram {
    /// Compiles the kernel that executes the program; also returns the sampler table.
    pub(super) fn load(self, gpu: &Gpu, kernel: &Kernel) -> Result<(LoadedProgram, Vec<u32>), MachineError> {
        let pipeline = gpu.kernel(kernel, &self.parts)?;
        let program = LoadedProgram { pipeline, code: self.code.words, registers: self.code.slots };
        Ok((program, self.samplers))
    }
}
