//! The programs for the drawing options on a device.

use refsim::device::Profile;
use refsim::exec::CheckedProgram;
use refsim::isa::Version;
use refsim::texture::SamplerState;

use super::options::{ProductPlace, VertexColors};
use super::subject::TransferredMesh;
use crate::all_frequency::Reflectance;
use crate::all_frequency::kernels::{MapFilter, ProductKernel, TransferredVertexKernel};
use crate::card::kernels::{COLOR, FLOAT_COLOR, SHADE, SHADE_COLOR};
use crate::card::{BILINEAR, CardError, KernelText, WrittenKernel, require_versions, vertex_version};

/// Checked programs.
#[derive(Clone, Debug)]
pub(super) struct Programs {
    pub(super) vertex: CheckedProgram,
    pub(super) pixel: CheckedProgram,
    /// True if the vertex program computes the view.
    pub(super) makes_view: bool,
    /// The sampler of the maps.
    pub(super) sampler: SamplerState,
}

impl Programs {
    pub(super) fn new(profile: &Profile, mesh: &TransferredMesh<'_>, place: &ProductPlace) -> Result<Self, CardError> {
        let colors = |vertex: KernelText, pixel: KernelText| -> Result<Self, CardError> {
            let (vertex, pixel) = (vertex.checked(profile)?, pixel.checked(profile)?);
            Ok(Self { vertex, pixel, makes_view: false, sampler: BILINEAR })
        };
        let (options, factors) = match (place, mesh.reflectance) {
            (ProductPlace::Pixels(options), Reflectance::Factored(factors)) => (options, factors),
            (ProductPlace::Vertices(VertexColors::Bytes), _) => return colors(COLOR, SHADE_COLOR),
            (ProductPlace::Vertices(VertexColors::Floats) | ProductPlace::Pixels(_), _) => {
                require_versions(profile, &[Version::Ps2_0], "the interpolation of floats")?;
                return colors(FLOAT_COLOR, SHADE);
            }
        };
        options.check(profile, factors.terms())?;
        let version = vertex_version(profile)?;
        let layout = options.layout(factors.terms());
        let vertex = TransferredVertexKernel { layout, version };
        let pixel = ProductKernel {
            layout,
            terms_per_texel: options.terms_per_texel(),
            filter: options.filter,
            side: factors.view_map().side(),
            is_partial: options.is_partial,
        };
        let (vertex, pixel) = (vertex.checked(profile)?, pixel.checked(profile)?);
        let sampler = if options.filter == MapFilter::Program { SamplerState::NEAREST_CLAMP } else { BILINEAR };
        Ok(Self { vertex, pixel, makes_view: true, sampler })
    }
}
