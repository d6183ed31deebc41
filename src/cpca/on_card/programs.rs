//! The programs for a transfer on a device, and the constants that they leave for clusters.

use refsim::device::Profile;
use refsim::exec::CheckedProgram;
use refsim::isa::Version;

use super::error::PrtCardError;
use super::options::PrtCardOptions;
use super::transfer::CompressedTransfer;
use crate::card::KernelError;
use crate::cpca::coherence::ConstantRegisters;
use crate::cpca::kernels::{DEPTH, ExitKernel, SHADE, SHADE_COLOR, VertexKernel, VertexShading};

/// Checked programs.
#[derive(Clone, Debug)]
pub(super) struct Programs {
    pub(super) kernel: VertexKernel,
    /// Position alone.
    pub(super) depth: CheckedProgram,
    /// For pixels of which only the depth is kept.
    pub(super) unseen: CheckedProgram,
    pub(super) vertex: CheckedProgram,
    pub(super) pixel: CheckedProgram,
}

/// The vertex program for a transfer on a device.
pub(super) fn kernel(
    profile: &Profile,
    transfer: &CompressedTransfer<'_>,
    options: &PrtCardOptions,
) -> Result<VertexKernel, PrtCardError> {
    let has = |version| profile.limits.versions.contains(&version);
    let shading = if transfer.is_glossy() {
        PrtCardError::check_version(profile, Version::Ps2_0, "glossy transfer")?;
        let (found, most) = (transfer.basis.len(), 4 * ExitKernel::MAX_REGISTERS);
        if found > most {
            return Err(PrtCardError::Functions { found, most });
        }
        VertexShading::Glossy { registers: found.div_ceil(4) }
    } else if has(Version::Ps2_0) {
        VertexShading::Diffuse
    } else {
        VertexShading::DiffuseColor
    };
    let best = if has(Version::Vs2_0) { Version::Vs2_0 } else { Version::Vs1_1 };
    let version = options.vertex_version.unwrap_or(best);
    PrtCardError::check_version(profile, version, "the vertex stage")?;
    let kernel = VertexKernel { shading, vectors: transfer.vectors, version };
    if transfer.vectors > kernel.most_vectors() {
        return Err(PrtCardError::Weights { found: transfer.vectors, most: kernel.most_vectors() });
    }
    Ok(kernel)
}

impl Programs {
    /// The vertex program with those that go with it, accepted by a device.
    pub(super) fn new(profile: &Profile, kernel: VertexKernel) -> Result<Self, KernelError> {
        let pixel = match kernel.shading {
            VertexShading::Diffuse => SHADE.checked(profile)?,
            VertexShading::DiffuseColor => SHADE_COLOR.checked(profile)?,
            VertexShading::Glossy { registers } => ExitKernel { registers }.checked(profile)?,
        };
        let (depth, unseen) = (DEPTH.checked(profile)?, SHADE_COLOR.checked(profile)?);
        Ok(Self { kernel, depth, unseen, vertex: kernel.checked(profile)?, pixel })
    }
}

/// The constants that a device leaves for products.
pub(super) fn registers(profile: &Profile, kernel: &VertexKernel) -> ConstantRegisters {
    let of_version = if kernel.version == Version::Vs1_1 { 96 } else { 256 };
    let all = profile.limits.vertex_constants.map_or(of_version, |limit| limit as usize).min(of_version);
    ConstantRegisters { limit: all.saturating_sub(kernel.first()), per_vector: kernel.per_vector() }
}
