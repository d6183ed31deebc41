//! The functions of exit radiance in parabolic maps: y(v_p) of section 6.2.

use refsim::machine::{Machine, MachineError, TextureId};
use refsim::num::Format;
use refsim::texture::{Image, TargetRounding, TexelFormat, TextureKind};

use crate::sphere::ParabolicMap;
use crate::transfer::brdf::ExitBasis;

/// Maps of four functions each, as textures, divided by a scale.
#[derive(Clone, Debug)]
pub(super) struct ExitMaps {
    pub(super) textures: Vec<TextureId>,
}

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
        let texture = |first: usize| {
            let four = |y: &Vec<f64>| [0, 1, 2, 3].map(|at| y.get(first + at).map_or(0.0, |y| (y / scale) as f32));
            map_texture(machine, (map, format), all.iter().map(four))
        };
        Ok(Self { textures: (0..basis.len()).step_by(4).map(texture).collect::<Result<_, _>>()? })
    }
}

/// A map as a texture: four numbers per texel, row by row, each rounded into the format once.
pub(crate) fn map_texture(
    machine: &mut Machine,
    (map, format): (ParabolicMap, TexelFormat),
    texels: impl Iterator<Item = [f32; 4]>,
) -> Result<TextureId, MachineError> {
    let extents = [map.side() as u32, map.side() as u32, 1];
    let texels: Vec<[u32; 4]> = texels.map(|texel| texel.map(f32::to_bits)).collect();
    let rounding = TargetRounding::Nearest;
    machine.create_texture(Image::from_values(format, TextureKind::D2, extents, Format::FP32, &texels, rounding)?)
}
