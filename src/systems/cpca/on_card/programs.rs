//! The programs for a transfer on a device, and the constants that they leave for clusters.

use refsim::device::Profile;
use refsim::exec::CheckedProgram;
use refsim::isa::Version;

use super::transfer::CompressedTransfer;
use crate::card::kernels::{SHADE, SHADE_COLOR};
use crate::card::{CardError, DepthPrograms, KernelError, WrittenKernel, require_versions, vertex_version};
use crate::cpca::coherence::ConstantRegisters;
use crate::cpca::kernels::{ExitKernel, VertexKernel, VertexShading};

/// Checked programs.
#[derive(Clone, Debug)]
pub(super) struct ShadingPrograms {
    pub(super) kernel: VertexKernel,
    pub(super) depth: DepthPrograms,
    pub(super) vertex: CheckedProgram,
    pub(super) pixel: CheckedProgram,
}

/// The vertex program for a transfer on a device.
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
    /// The vertex program with those that go with it, accepted by a device.
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
