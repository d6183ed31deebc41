//! The programs for the drawing options on a device.

use refsim::device::Profile;
use refsim::exec::CheckedProgram;
use refsim::isa::Version;

use super::error::FactoredCardError;
use super::options::{ProductOptions, ProductPlace, VertexColors, ViewMaker};
use super::subject::TransferredMesh;
use crate::all_frequency::Reflectance;
use crate::all_frequency::kernels::{ProductKernel, TransferredVertexKernel};
use crate::card::kernels::{COLOR, FLOAT_COLOR, SHADE, SHADE_COLOR};
use crate::card::{require_versions, vertex_version};

/// The kind of drawing that the programs do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Drawing {
    /// Vertex colors.
    Colors,
    /// Products per pixel.
    Products(ProductKernel),
}

/// Checked programs.
#[derive(Clone, Debug)]
pub(super) struct Programs {
    pub(super) drawing: Drawing,
    pub(super) vertex: CheckedProgram,
    pub(super) pixel: CheckedProgram,
    makes_view: bool,
}

impl Programs {
    pub(super) fn new(
        profile: &Profile,
        mesh: &TransferredMesh<'_>,
        place: &ProductPlace,
    ) -> Result<Self, FactoredCardError> {
        match (place, mesh.reflectance) {
            (ProductPlace::Vertices(VertexColors::Bytes), _) => {
                let (vertex, pixel) = (COLOR.checked(profile)?, SHADE_COLOR.checked(profile)?);
                Ok(Self { drawing: Drawing::Colors, vertex, pixel, makes_view: false })
            }
            (ProductPlace::Pixels(options), Reflectance::Factored(factors)) => {
                options.check(profile, factors.terms())?;
                Self::products(profile, options, (factors.terms(), factors.view_map().side()))
            }
            (ProductPlace::Vertices(VertexColors::Floats) | ProductPlace::Pixels(_), _) => {
                require_versions(profile, &[Version::Ps2_0], "the interpolation of floats")?;
                let (vertex, pixel) = (FLOAT_COLOR.checked(profile)?, SHADE.checked(profile)?);
                Ok(Self { drawing: Drawing::Colors, vertex, pixel, makes_view: false })
            }
        }
    }

    fn products(
        profile: &Profile,
        options: &ProductOptions,
        (terms, side): (usize, usize),
    ) -> Result<Self, FactoredCardError> {
        let version = vertex_version(profile, options.vertex_version)?;
        let layout = options.layout(terms);
        let computes_view = options.view_maker == ViewMaker::Program;
        let vertex = TransferredVertexKernel { layout, computes_view, version };
        let kernel = ProductKernel {
            layout,
            terms_per_texel: options.terms_per_texel(),
            filter: options.filter,
            side,
            is_partial: options.is_partial,
        };
        let (vertex, pixel) = (vertex.checked(profile)?, kernel.checked(profile)?);
        Ok(Self { drawing: Drawing::Products(kernel), vertex, pixel, makes_view: computes_view })
    }

    /// True if the vertex program computes the view.
    pub(super) fn makes_view(&self) -> bool {
        self.makes_view
    }
}
