//! The block-channel product of reference 8 on a card: half as many texels a side as the matrix has rows, four elements a texel.

use std::sync::Arc;

use refsim::device::Profile;
use refsim::exec::Constants;
use refsim::machine::{DrawCall, Executor, Machine, TextureId, VertexSource};
use refsim::raster::{PixelCenter, Primitive};
use refsim::texture::{SamplerState, TexelFormat};

use super::fit::{limits, too_large};
use super::layer::same;
use super::programs::Programs;
use super::{CardError, PassProgram};
use crate::card;
use crate::radiosity::kernels;
use crate::radiosity::packing::{Texels, TooLarge};

/// The most texels of a block on a device, and so the steps of a pass.
///
/// # Errors
/// [`CardError::NoPrograms`].
pub fn product_block(profile: &Profile) -> Result<usize, CardError> {
    let (instructions, _) = limits(profile)?;
    Ok(kernels::PRODUCT_FIRST.block(instructions).min(kernels::PRODUCT_NEXT.block(instructions)).max(1))
}

/// The product of two block-channel matrices (see [`crate::radiosity::packing::block_channel_matrix`]), `block` steps a pass, with the
/// programs that made it. The card's answer is [`crate::radiosity::packing::block_channel_product`]'s to the bit.
///
/// # Errors
/// [`CardError`]: no programs of such length, too large, of two sizes, blocks longer than [`product_block`].
pub fn product(
    profile: impl Into<Arc<Profile>>,
    executor: impl Into<Executor>,
    [left, right]: [&Texels; 2],
    block: usize,
) -> Result<(Texels, Vec<PassProgram>), CardError> {
    let profile = profile.into();
    let (_, limit) = limits(&profile)?;
    let size = left.width;
    for texels in [left, right] {
        same("columns, as the left matrix has", size, texels.width)?;
        same("rows, as the left matrix has columns", size, texels.height)?;
    }
    if size > limit {
        return Err(too_large(&profile, TooLarge { what: "a matrix", limit, width: size, height: size }));
    }
    let programs = Programs::new(&profile, [kernels::PRODUCT_FIRST, kernels::PRODUCT_NEXT], size, block)?;
    let mut machine = executor.into().machine(profile)?;
    let upload = |machine: &mut Machine, texels: &Texels| -> Result<TextureId, CardError> {
        Ok(machine.create_texture(card::float_image(TexelFormat::Rgba32f, [size; 2], &texels.texels)?)?)
    };
    let factors = [upload(&mut machine, left)?, upload(&mut machine, right)?];
    let mut target = || -> Result<TextureId, CardError> {
        Ok(machine.create_target_from(card::empty_image(TexelFormat::Rgba32f, [size; 2])?)?)
    };
    let targets = [target()?, target()?];
    for number in 0..programs.passes.len() {
        pass(&mut machine, &programs, number, (factors, targets, size))?;
    }
    let last = targets[(programs.passes.len().max(1) - 1) % 2];
    let texels = card::floats(machine.read_back(last)?);
    Ok((Texels { width: size, height: size, texels }, programs.list))
}

/// One quad over the product.
fn pass(
    machine: &mut Machine,
    programs: &Programs,
    number: usize,
    (factors, targets, size): ([TextureId; 2], [TextureId; 2], usize),
) -> Result<(), CardError> {
    let pass = programs.passes[number];
    let (step, side) = (pass.from as f32 + 0.5, size as f32);
    let corners = card::quad(|u, v| [[step, v * side, u * side, 1.0], [u * side, v * side, 0.0, 1.0]]);
    let constants = Constants::default();
    let program = &programs.list[pass.program].checked;
    let source = VertexSource::Transformed(&corners);
    let mut call = DrawCall::new(source, Primitive::QuadList, program, &constants, targets[number % 2]);
    for (sampler, texture) in factors.into_iter().enumerate() {
        call = call.with_texture(sampler, texture, SamplerState::NEAREST_CLAMP);
    }
    if number > 0 {
        call = call.with_texture(2, targets[(number + 1) % 2], SamplerState::NEAREST_CLAMP);
    }
    call.center = PixelCenter::OpenGl;
    machine.draw(&call)?;
    Ok(())
}
