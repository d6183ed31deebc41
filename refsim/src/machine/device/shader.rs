//! The pixel program of a draw as the GPU runs it.

use super::Card;
use crate::device::Profile;
use crate::event::SAMPLERS;
use crate::exec::gpu::Shader;
use crate::exec::wgsl::program::{self, PixelShader};
use crate::exec::wgsl::{follow, kernel, texture};
use crate::exec::{PixelBindings, SamplerBinding, sample_rules};
use crate::machine::memory::Memory;
use crate::machine::{DrawCall, MachineError};

/// Program and samplers of a draw, or of pixels that are followed through one; the textures are on the GPU then.
pub(super) fn shader(
    card: &mut Card,
    memory: &Memory,
    profile: &Profile,
    call: &DrawCall<'_>,
    followed: bool,
) -> Result<(Shader, Vec<u32>), MachineError> {
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
    let prepare = if followed { PixelShader::traced } else { PixelShader::new };
    let code = prepare(call.pixel_program, &profile.rules, &bindings)?.microcode()?;
    let (text, entry) = match followed {
        true => (followed_text(&card.library), follow::ENTRY),
        false => (card.text.clone(), kernel::ENTRY),
    };
    Ok((Shader { text, entry, code: code.words, registers: code.slots }, samplers))
}

/// The module that runs every program.
pub(super) fn machine_text(library: &str) -> String {
    let mut text = kernel::text(library);
    for part in [program::machine(), program::NO_OUTPUT, program::NO_TRACE, &texture::library()] {
        text += part;
        text.push('\n');
    }
    text
}

/// The module that follows pixels.
fn followed_text(library: &str) -> String {
    [&follow::text(library), program::machine(), program::NO_OUTPUT, &texture::library()]
        .map(|part| part.to_owned() + "\n")
        .concat()
}
