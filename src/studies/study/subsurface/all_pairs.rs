//! Reference for all ways of gathering: equation 9 over all pairs of texels.

use super::Parameters;
use crate::atlas::Atlas;
use crate::picture::metrics::{ErrorSums, value_error};
use crate::study::{ProgressFn, StudyError};
use crate::subsurface::{Dipole, Material, Reference};

/// Errors of radiosities relative to expected ones; infinite if only one of two radiosities is finite.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct GatherError {
    /// RMS difference relative to the RMS of the expected values; weighted by area, over all channels.
    pub(super) rms: f64,
    /// Largest difference relative to the largest expected value.
    pub(super) largest: f64,
}

impl GatherError {
    pub(super) fn between(atlas: &Atlas, found: &[[f64; 3]], expected: &[[f64; 3]]) -> Self {
        let [mut off, mut reference] = [ErrorSums::default(); 2];
        for ((texel, found), expected) in atlas.texels().iter().zip(found).zip(expected) {
            for (&found, &expected) in found.iter().zip(expected) {
                off.add(value_error(found, expected), texel.area);
                if expected.is_finite() {
                    reference.add(expected, texel.area);
                }
            }
        }
        let over = |a: f64, b: f64| if a.is_infinite() || b > 0.0 { a / b } else { 0.0 };
        Self { rms: over(off.squares(), reference.squares()).sqrt(), largest: over(off.largest, reference.largest) }
    }
}

/// Radiosities of all texels, row by row. A channel that equals an earlier channel reuses its sums.
pub(super) fn radiosity(
    parameters: &Parameters,
    atlas: &Atlas,
    dipoles: &[Dipole; 3],
    irradiance: &[[f64; 3]],
    progress: &mut ProgressFn<'_>,
) -> Result<Vec<[f64; 3]>, StudyError> {
    let mut texels = vec![[0.0; 3]; irradiance.len()];
    for (channel, name) in Material::CHANNELS.iter().enumerate() {
        let is_like = |other: &usize| {
            dipoles[*other].coefficients() == dipoles[channel].coefficients()
                && irradiance.iter().all(|e| e[*other] == e[channel])
        };
        if let Some(other) = (0..channel).find(is_like) {
            texels.iter_mut().for_each(|b| b[channel] = b[other]);
            continue;
        }
        let step = format!("all pairs of texels, {name}");
        let mut done = |done, rows| progress(&step, done as u64, rows as u64);
        let values: Vec<f64> = irradiance.iter().map(|e| e[channel]).collect();
        let reference = Reference::new(atlas, parameters.options.mm_per_unit, &dipoles[channel])?;
        let radiosity = reference.radiosity(&values, 0..atlas.side() as usize, &mut done)?;
        texels.iter_mut().zip(radiosity).for_each(|(into, b)| into[channel] = b);
    }
    Ok(texels)
}
