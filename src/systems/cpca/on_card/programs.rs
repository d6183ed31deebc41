//! The programs for a transfer on a device, the constant registers that they leave for clusters, and the maps that they
//! read.

use refsim::device::Profile;
use refsim::exec::CheckedProgram;
use refsim::isa::Version;
use refsim::machine::{Machine, MachineError};
use refsim::texture::{TexelFormat, TextureKind};

use super::transfer::CompressedTransfer;
use crate::card::kernels::{SHADE, SHADE_COLOR};
use crate::card::{
    BILINEAR, CardError, DepthPrograms, KernelError, ReadTexture, WrittenKernel, new_texture, require_versions,
    vertex_version,
};
use crate::cpca::coherence::ConstantRegisters;
use crate::cpca::kernels::{ExitKernel, VertexKernel, VertexShading};
use crate::sphere::ParabolicMap;
use crate::transfer::brdf::ExitBasis;

#[derive(Clone, Debug)]
pub(super) struct ShadingPrograms {
    pub(super) kernel: VertexKernel,
    pub(super) depth: DepthPrograms,
    pub(super) vertex: CheckedProgram,
    pub(super) pixel: CheckedProgram,
}

pub(super) fn kernel(profile: &Profile, transfer: &CompressedTransfer<'_>) -> Result<VertexKernel, CardError> {
    let shading = if transfer.is_glossy() {
        require_versions(profile, &[Version::Ps2_0], "glossy transfer")?;
        let (found, most) = (transfer.basis.len(), 4 * ExitKernel::MAX_REGISTERS);
        if found > most {
            return Err(CardError::input(format!(
                "expected at most {most} functions of exit radiance, which fit 7 sets of coordinates, found {found}"
            )));
        }
        VertexShading::Glossy { registers: found.div_ceil(4) }
    } else if profile.limits.versions.contains(&Version::Ps2_0) {
        VertexShading::Diffuse
    } else {
        VertexShading::DiffuseColor
    };
    let version = vertex_version(profile)?;
    let kernel = VertexKernel { shading, vectors: transfer.vectors, version };
    let (found, most) = (transfer.vectors, kernel.most_vectors());
    if found > most {
        return Err(CardError::input(format!(
            "expected at most {most} vectors, whose weights fit the attributes of a vertex, found {found}"
        )));
    }
    Ok(kernel)
}

impl ShadingPrograms {
    pub(super) fn new(profile: &Profile, kernel: VertexKernel) -> Result<Self, KernelError> {
        let pixel = match kernel.shading {
            VertexShading::Diffuse => SHADE.checked(profile)?,
            VertexShading::DiffuseColor => SHADE_COLOR.checked(profile)?,
            VertexShading::Glossy { registers } => ExitKernel { registers }.checked(profile)?,
        };
        Ok(Self { kernel, depth: DepthPrograms::new(profile)?, vertex: kernel.checked(profile)?, pixel })
    }
}

/// The constants that a device leaves for products.
pub(super) fn registers(profile: &Profile, kernel: &VertexKernel) -> ConstantRegisters {
    let of_version = if kernel.version == Version::Vs1_1 { 96 } else { 256 };
    let all = profile.limits.vertex_constants.map_or(of_version, |limit| limit as usize).min(of_version);
    ConstantRegisters { limit: all.saturating_sub(kernel.first()), per_vector: kernel.per_vector() }
}

/// Uploads maps of four functions each, with texels outside the disc evaluated below the horizon; returns textures with
/// their sampler states, and the divisor of the functions: 1 for floating point, otherwise the least power of two that
/// brings all texels into [-1, 1].
pub(super) fn exit_maps(
    machine: &mut Machine,
    basis: &ExitBasis,
    map: ParabolicMap,
    format: TexelFormat,
) -> Result<(Vec<ReadTexture>, f64), MachineError> {
    let texel = |at: usize| {
        let mut y = vec![0.0; basis.len()];
        basis.values(map.direction(at % map.side(), at / map.side()), &mut y);
        y
    };
    let all: Vec<Vec<f64>> = (0..map.texels()).map(texel).collect();
    let most = all.iter().flatten().fold(0.0_f64, |most, value| most.max(value.abs()));
    let mut scale = 1.0;
    while !format.record().is_float() && most > scale {
        scale *= 2.0;
    }
    let extents = [map.side() as u32, map.side() as u32, 1];
    let texture = |first: usize| {
        let four = |y: &Vec<f64>| [0, 1, 2, 3].map(|at| y.get(first + at).map_or(0.0, |y| (y / scale) as f32));
        Ok((new_texture(machine, format, TextureKind::D2, extents, all.iter().map(four))?, BILINEAR))
    };
    Ok(((0..basis.len()).step_by(4).map(texture).collect::<Result<_, MachineError>>()?, scale))
}
