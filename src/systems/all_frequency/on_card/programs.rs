//! The programs for the drawing options on a device, and the maps of G that they read.

use refsim::device::Profile;
use refsim::exec::CheckedProgram;
use refsim::isa::Version;
use refsim::machine::{Machine, MachineError, TextureId};
use refsim::texture::{SamplerState, TextureKind};

use super::attributes::TransferredMesh;
use super::options::{ProductOptions, ProductPlace, VertexColors};
use crate::all_frequency::Reflectance;
use crate::all_frequency::factor::ProductFactors;
use crate::all_frequency::kernels::{MapFilter, ProductKernel, TransferredVertexKernel};
use crate::card::kernels::{COLOR, FLOAT_COLOR, SHADE, SHADE_COLOR};
use crate::card::{BILINEAR, CardError, KernelText, WrittenKernel, new_texture, require_versions, vertex_version};

#[derive(Clone, Debug)]
pub(super) struct Programs {
    pub(super) vertex: CheckedProgram,
    pub(super) pixel: CheckedProgram,
    pub(super) makes_view: bool,
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

/// Maps of G as textures.
#[derive(Clone, Debug)]
pub(super) struct FactorMaps {
    pub(super) textures: Vec<TextureId>,
    /// For each term, the factor that scales its texels.
    pub(super) scales: Vec<f64>,
}

impl FactorMaps {
    pub(super) fn new(
        machine: &mut Machine,
        factors: &ProductFactors,
        options: &ProductOptions,
    ) -> Result<Self, MachineError> {
        let (map, terms) = (factors.view_map(), factors.terms());
        let is_fraction = options.map_bits.is_some() || !options.map_format.record().is_float();
        let scale = |term: usize| {
            let magnitudes = (0..map.texels()).map(|texel| factors.view_texel(texel)[term].abs());
            let most = magnitudes.fold(0.0, f64::max);
            if is_fraction && most > 0.0 { most } else { 1.0 }
        };
        let scales: Vec<f64> = (0..terms).map(scale).collect();
        let value = |texel: usize, term: usize| {
            let value = factors.view_texel(texel).get(term).map_or(0.0, |g| g / scales[term]);
            match options.map_bits {
                Some(bits) => {
                    let most = f64::from((1_u32 << (bits - 1)) - 1);
                    ((value * most).round_ties_even() / most) as f32
                }
                None => value as f32,
            }
        };
        let per_texel = options.terms_per_texel();
        let texture = |(number, first): (usize, usize)| {
            let texels = (0..map.texels()).map(|texel| match (per_texel, number % 2) {
                (4, _) => [0, 1, 2, 3].map(|at| value(texel, first + at)),
                (_, 0) => [value(texel, first), value(texel, first + 1), 0.0, 0.0],
                // The two terms are exchanged, because the program combines this map with the previous one.
                _ => [value(texel, first + 1), value(texel, first), 0.0, 0.0],
            });
            new_texture(machine, options.map_format, TextureKind::D2, [map.side() as u32, map.side() as u32, 1], texels)
        };
        let textures = (0..terms).step_by(per_texel).enumerate().map(texture).collect::<Result<_, _>>()?;
        Ok(Self { textures, scales })
    }
}
