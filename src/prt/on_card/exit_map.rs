//! The functions of exit radiance in parabolic maps: y(v_p) of section 6.2.

use refsim::machine::{Machine, MachineError, TextureId};
use refsim::num::Format;
use refsim::texture::{AddressMode, Filter, Image, SamplerState, TargetRounding, TexelFormat, TextureKind};

use crate::prt::brdf::ExitBasis;
use crate::sphere::ParabolicMap;

/// Maps of four functions each, as textures, divided by a scale.
#[derive(Clone, Debug)]
pub(super) struct ExitMaps {
    pub(super) textures: Vec<TextureId>,
}

/// Linear within a level, clamped at the border.
pub(super) const SAMPLER: SamplerState = SamplerState {
    min: Filter::Linear,
    mag: Filter::Linear,
    address_u: AddressMode::Clamp,
    address_v: AddressMode::Clamp,
    ..SamplerState::NEAREST_CLAMP
};

/// What functions are divided by in a format: 1, or a power of two that brings all texels of signed fractions within
/// [-1, 1].
pub(super) fn map_scale(basis: &ExitBasis, map: ParabolicMap, format: TexelFormat) -> f64 {
    let most = texels(basis, map).flatten().fold(0.0, |most: f64, value| most.max(value.abs()));
    let float = format.record().is_float();
    std::iter::successors(Some(1.0), |scale| Some(2.0 * scale)).find(|&scale| float || most <= scale).unwrap_or(1.0)
}

/// The functions at each texel, row by row. Beyond the rim they continue below the horizon.
fn texels(basis: &ExitBasis, map: ParabolicMap) -> impl Iterator<Item = Vec<f64>> {
    let places = (0..map.side()).flat_map(move |row| (0..map.side()).map(move |column| (column, row)));
    places.map(move |(column, row)| {
        let mut y = vec![0.0; basis.len()];
        basis.values(map.direction(column, row), &mut y);
        y
    })
}

impl ExitMaps {
    /// The maps of a basis.
    pub(super) fn new(
        machine: &mut Machine,
        basis: &ExitBasis,
        (map, format, scale): (ParabolicMap, TexelFormat, f64),
    ) -> Result<Self, MachineError> {
        let all: Vec<Vec<f64>> = texels(basis, map).collect();
        let extents = [map.side() as u32, map.side() as u32, 1];
        let texture = |first: usize| {
            let four =
                |y: &Vec<f64>| [0, 1, 2, 3].map(|at| y.get(first + at).map_or(0, |y| ((y / scale) as f32).to_bits()));
            let texels: Vec<[u32; 4]> = all.iter().map(four).collect();
            let rounding = TargetRounding::Nearest;
            let image = Image::from_values(format, TextureKind::D2, extents, Format::FP32, &texels, rounding)?;
            machine.create_texture(image)
        };
        Ok(Self { textures: (0..basis.len()).step_by(4).map(texture).collect::<Result<_, _>>()? })
    }
}
