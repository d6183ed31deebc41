//! Reference for all ways of gathering: equation 9 over all pairs of texels.

use super::Parameters;
use crate::atlas::Atlas;
use crate::picture::metrics::{ErrorSums, value_error};
use crate::study::{ProgressFn, StudyError};
use crate::subsurface::{Dipole, Reference};

/// Names of the channels.
const CHANNELS: [&str; 3] = ["red", "green", "blue"];

/// Errors of radiosities relative to expected ones; infinite if only one of two radiosities is finite.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct GatherError {
    /// RMS difference relative to the RMS of the expected values; weighted by area, over all channels.
    pub(super) rms: f64,
    /// Largest difference relative to the largest expected value.
    pub(super) largest: f64,
}

impl GatherError {
    /// Error of `found` compared with `expected`, per texel.
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

/// Sums over all pairs of texels for one lit model.
#[derive(Clone, Copy)]
pub(super) struct AllPairSums<'a> {
    pub(super) atlas: &'a Atlas,
    pub(super) parameters: &'a Parameters,
    /// Dipoles for red, green and blue.
    pub(super) dipoles: &'a [Dipole; 3],
    pub(super) irradiance: &'a [[f64; 3]],
}

impl AllPairSums<'_> {
    /// Radiosities of all texels, row by row. A channel that equals an earlier one has its sums.
    pub(super) fn radiosity(self, progress: &mut ProgressFn<'_>) -> Result<Vec<[f64; 3]>, StudyError> {
        let mut texels = vec![[0.0; 3]; self.irradiance.len()];
        for (channel, name) in CHANNELS.iter().enumerate() {
            if let Some(other) = self.like(channel) {
                texels.iter_mut().for_each(|b| b[channel] = b[other]);
                continue;
            }
            let step = format!("all pairs of texels, {name}");
            let mut done = |done, rows| progress(&step, done as u64, rows as u64);
            let values: Vec<f64> = self.irradiance.iter().map(|e| e[channel]).collect();
            let reference = Reference::new(self.atlas, self.parameters.options.mm_per_unit, &self.dipoles[channel])?;
            let radiosity = reference.radiosity(&values, &mut done)?;
            texels.iter_mut().zip(radiosity).for_each(|(into, b)| into[channel] = b);
        }
        Ok(texels)
    }

    /// The first earlier channel with the same medium and light.
    fn like(self, channel: usize) -> Option<usize> {
        (0..channel).find(|&other| {
            self.dipoles[other].coefficients() == self.dipoles[channel].coefficients()
                && self.irradiance.iter().all(|e| e[other] == e[channel])
        })
    }
}
