//! The block-channel product of reference 8 on a card: four elements per texel, half as many texels per side as the
//! matrix has rows.

use std::sync::Arc;

use refsim::device::Profile;
use refsim::exec::Constants;
use refsim::machine::Executor;
use refsim::output::WriteMask;
use refsim::texture::TexelFormat;

use super::PassProgram;
use super::fit::{limits, too_large};
use super::programs::Programs;
use crate::card::{CardError, FullScreenPass, PingPong, Texels, nearest};
use crate::radiosity::{kernels, packing};

/// The largest block on a device, in texels: the steps of a pass. Fails with [`CardError::Input`] for a device without
/// programs of such length.
pub fn product_block(profile: &Profile) -> Result<usize, CardError> {
    let (instructions, _) = limits(profile)?;
    Ok(kernels::PRODUCT_FIRST.block(instructions).min(kernels::PRODUCT_NEXT.block(instructions)).max(1))
}

/// The product of two block-channel matrices (see [`crate::radiosity::packing::block_channel_matrix`]), `block` steps
/// per pass, and the programs that ran. The result is that of [`crate::radiosity::packing::block_channel_product`] to
/// the bit. Fails with [`CardError`] if the device has no such programs, the matrices are too large or differ in size,
/// or the block is longer than [`product_block`].
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
        CardError::check_size("columns, as the left matrix has", size, texels.width)?;
        CardError::check_size("rows, as the left matrix has columns", size, texels.height)?;
    }
    if size > limit {
        return Err(too_large(&profile, packing::too_large("a matrix", limit, [size; 2])));
    }
    let programs = Programs::new(&profile, [kernels::PRODUCT_FIRST, kernels::PRODUCT_NEXT], size, block)?;
    let mut machine = executor.into().machine(profile)?;
    let format = TexelFormat::Rgba32f;
    let [left, right] = [left.upload(&mut machine, format)?, right.upload(&mut machine, format)?];
    let sums = PingPong::new(&mut machine, format, [size; 2])?;
    let side = size as f32;
    for (number, pass) in programs.passes.iter().enumerate() {
        let textures = nearest([left, right, sums.read_by(number)]);
        let step = pass.from as f32 + 0.5;
        FullScreenPass {
            program: &programs.list[pass.program].checked,
            constants: &Constants::default(),
            // The first pass starts from 0.
            textures: if number == 0 { &textures[..2] } else { &textures },
            target: sums.written_by(number),
            mask: WriteMask::ALL,
            part: None,
        }
        .draw(&mut machine, |u, v| [[step, v * side, u * side, 1.0], [u * side, v * side, 0.0, 1.0]])?;
    }
    let last = sums.written_by(programs.passes.len().max(1) - 1);
    Ok((Texels::read_back(&machine, last)?, programs.list))
}
