//! G in parabolic maps.

use refsim::machine::{Machine, MachineError, TextureId};
use refsim::texture::TextureKind;

use super::options::ProductOptions;
use crate::all_frequency::factor::ProductFactors;
use crate::card::new_texture;

/// Maps of G as textures.
#[derive(Clone, Debug)]
pub(super) struct FactorMaps {
    pub(super) textures: Vec<TextureId>,
    /// Per term what texels are to be multiplied by.
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
                // Exchanged, as the program joins it with the one before.
                _ => [value(texel, first + 1), value(texel, first), 0.0, 0.0],
            });
            new_texture(machine, options.map_format, TextureKind::D2, [map.side() as u32, map.side() as u32, 1], texels)
        };
        let textures = (0..terms).step_by(per_texel).enumerate().map(texture).collect::<Result<_, _>>()?;
        Ok(Self { textures, scales })
    }
}
