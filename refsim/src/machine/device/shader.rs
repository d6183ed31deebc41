//! The pixel program of a draw, encoded for the GPU.

use super::Card;
use crate::device::Profile;
use crate::event::SAMPLERS;
use crate::exec::gpu::{BINDINGS, Kernel, LoadedProgram};
use crate::exec::wgsl::kernel::DrawWords;
use crate::exec::wgsl::program::{self, PixelShader};
use crate::exec::wgsl::{follow, kernel, texture};
use crate::exec::{PixelBindings, SamplerBinding, sample_rules};
use crate::machine::memory::Memory;
use crate::machine::{DrawCall, MachineError};

/// Kernel that draws tiles.
pub(super) const DRAW: Kernel = Kernel {
    entry: kernel::ENTRY,
    text: || kernel::text() + &program::machine() + program::NO_TRACE + &texture::library(),
    bindings: &BINDINGS,
};

/// Kernel that traces pixels.
pub(super) const FOLLOW: Kernel = Kernel {
    entry: follow::ENTRY,
    text: || follow::text() + &program::machine() + &texture::library(),
    bindings: &BINDINGS,
};

/// Encodes and uploads the program and the samplers of a draw, and the textures they read.
pub(super) fn load(
    card: &mut Card,
    memory: &Memory,
    profile: &Profile,
    call: &DrawCall<'_>,
    words: &mut DrawWords,
    kernel: &Kernel,
) -> Result<(LoadedProgram, Vec<u32>), MachineError> {
    let rules = sample_rules(&profile.rules);
    let (bump, projections) = (call.bump, call.projections);
    let mut bindings = PixelBindings { bump, projections, ..PixelBindings::new(call.pixel_constants) };
    let mut samplers = Vec::with_capacity(SAMPLERS * texture::SAMPLER_WORDS);
    for (slot, bound) in bindings.samplers.iter_mut().zip(&call.samplers) {
        let mut first = 0;
        if let Some(bound) = bound {
            let image = memory.current(bound.texture)?;
            first = card.place_texture(bound.texture.0, image)?;
            *slot = Some(SamplerBinding { image, state: bound.state });
        }
        samplers.extend(texture::sampler_words(slot.as_ref(), &rules, first as u32));
    }
    let traced = kernel.entry == follow::ENTRY;
    let shader = PixelShader::new(call.pixel_program, &profile.rules, &bindings, traced);
    let code = shader.microcode(Some(words.interpolation()))?;
    let mut parts = words.parts_with(&code);
    for &sampler in &code.samplers {
        texture::parts(&samplers[sampler * texture::SAMPLER_WORDS..], &mut parts);
    }
    let pipeline = card.board.gpu().kernel(kernel, &parts)?;
    Ok((LoadedProgram { pipeline, code: code.words, registers: code.slots }, samplers))
}
