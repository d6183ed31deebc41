//! The functions of exit radiance, y(v_p) of section 6.2, in parabolic maps.

use refsim::machine::{Machine, MachineError};
use refsim::texture::{TexelFormat, TextureKind};

use crate::card::{BILINEAR, ReadTexture, new_texture};
use crate::sphere::ParabolicMap;
use crate::transfer::brdf::ExitBasis;

/// The divisor of the functions in a format: 1 for floating point, otherwise the least power of two that brings all
/// texels into [-1, 1].
pub(super) fn map_scale(basis: &ExitBasis, map: ParabolicMap, format: TexelFormat) -> f64 {
    let most = texels(basis, map).flatten().fold(0.0, |most: f64, value| most.max(value.abs()));
    let float = format.record().is_float();
    std::iter::successors(Some(1.0), |scale| Some(2.0 * scale)).find(|&scale| float || most <= scale).unwrap_or(1.0)
}

/// The functions at each texel, row by row. Outside the disc they are evaluated below the horizon.
fn texels(basis: &ExitBasis, map: ParabolicMap) -> impl Iterator<Item = Vec<f64>> {
    let places = (0..map.side()).flat_map(move |row| (0..map.side()).map(move |column| (column, row)));
    places.map(move |(column, row)| {
        let mut y = vec![0.0; basis.len()];
        basis.values(map.direction(column, row), &mut y);
        y
    })
}

/// Maps of four functions each, divided by a scale, as textures with their sampler states.
pub(super) fn exit_maps(
    machine: &mut Machine,
    basis: &ExitBasis,
    map: ParabolicMap,
    format: TexelFormat,
    scale: f64,
) -> Result<Vec<ReadTexture>, MachineError> {
    let all: Vec<Vec<f64>> = texels(basis, map).collect();
    let extents = [map.side() as u32, map.side() as u32, 1];
    let texture = |first: usize| {
        let four = |y: &Vec<f64>| [0, 1, 2, 3].map(|at| y.get(first + at).map_or(0.0, |y| (y / scale) as f32));
        Ok((new_texture(machine, format, TextureKind::D2, extents, all.iter().map(four))?, BILINEAR))
    };
    (0..basis.len()).step_by(4).map(texture).collect()
}
