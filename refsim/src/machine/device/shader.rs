//! The pixel program of a draw, encoded for the GPU.

use super::Card;
use crate::device::Profile;
use crate::exec::gpu::{BINDINGS, Kernel, LoadedProgram};
use crate::exec::wgsl::kernel::DrawWords;
use crate::exec::wgsl::{kernel, program, texture};
use crate::machine::memory::Memory;
use crate::machine::trace_layout::{EncodedProgram, VideoMemory};
use crate::machine::{DrawCall, MachineError};
use crate::texture::Image;

const DRAW: Kernel = Kernel {
    entry: kernel::ENTRY,
    text: || kernel::text() + &program::machine() + program::NO_TRACE + &texture::library(),
    bindings: &BINDINGS,
};

impl VideoMemory for Card {
    fn allocate(&mut self, words: usize) -> Result<usize, MachineError> {
        Ok(self.board.allocate(words)?)
    }

    fn place_texture(&mut self, number: usize, image: &Image) -> Result<usize, MachineError> {
        Ok(Self::place_texture(self, number, image)?)
    }
}

/// Encodes the program of a draw, places the textures that it reads, and compiles the kernel that executes it; also
/// returns the sampler table.
pub(super) fn load(
    card: &mut Card,
    memory: &Memory,
    profile: &Profile,
    call: &DrawCall<'_>,
    words: &mut DrawWords,
) -> Result<(LoadedProgram, Vec<u32>), MachineError> {
    let encoded = EncodedProgram::new(card, memory, profile, call, words, false)?;
    let pipeline = card.board.gpu().kernel(&DRAW, &encoded.parts)?;
    let program = LoadedProgram { pipeline, code: encoded.code.words, registers: encoded.code.slots };
    Ok((program, encoded.samplers))
}
