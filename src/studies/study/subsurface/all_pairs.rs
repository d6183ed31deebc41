//! Reference for all ways of gathering: equation 9 over all pairs of texels.

use super::Parameters;
use crate::atlas::Atlas;
use crate::study::{ProgressFn, StudyError};
use crate::subsurface::{Dipole, Reference};

/// Names of the channels.
const CHANNELS: [&str; 3] = ["red", "green", "blue"];

/// Radiosities over all pairs, in f64.
#[derive(Clone, Debug, PartialEq)]
pub struct AllPairs {
    /// Per texel, row by row.
    pub texels: Vec<[f64; 3]>,
    /// Per probe.
    pub probes: Vec<[f64; 3]>,
}

/// How far radiosities are from others, as shares of the others.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GatherError {
    /// Root of the mean squared difference, over that of the others' values; by area, over all channels.
    pub rms: f64,
    /// The largest difference over the others' largest value.
    pub largest: f64,
}

impl GatherError {
    /// Of `found` against `expected`, per texel.
    pub(super) fn between(atlas: &Atlas, found: &[[f64; 3]], expected: &[[f64; 3]]) -> Self {
        let (mut squares, mut reference, mut largest, mut most) = (0.0, 0.0, 0.0_f64, 0.0_f64);
        for ((texel, found), expected) in atlas.texels().iter().zip(found).zip(expected) {
            for (found, expected) in found.iter().zip(expected) {
                let difference = found - expected;
                squares += texel.area * difference * difference;
                reference += texel.area * expected * expected;
                largest = largest.max(difference.abs());
                most = most.max(expected.abs());
            }
        }
        let over = |a: f64, b: f64| if b > 0.0 { a / b } else { 0.0 };
        Self { rms: over(squares, reference).sqrt(), largest: over(largest, most) }
    }
}

/// All pairs, once for each pair of channels that differ; `dipoles` are those of red, green and blue.
pub(super) fn gather(
    atlas: &Atlas,
    parameters: &Parameters,
    dipoles: &[Dipole; 3],
    irradiance: &[[f64; 3]],
    progress: &mut ProgressFn<'_>,
) -> Result<AllPairs, StudyError> {
    let mut found =
        AllPairs { texels: vec![[0.0; 3]; irradiance.len()], probes: vec![[0.0; 3]; parameters.probes.len()] };
    for channel in 0..3 {
        let values: Vec<f64> = irradiance.iter().map(|e| e[channel]).collect();
        let same = |&other: &usize| {
            dipoles[other].coefficients() == dipoles[channel].coefficients()
                && irradiance.iter().all(|e| e[other] == e[channel])
        };
        if let Some(other) = (0..channel).find(same) {
            found.texels.iter_mut().chain(&mut found.probes).for_each(|b| b[channel] = b[other]);
            continue;
        }
        let reference = Reference::new(atlas, parameters.mm_per_unit, &dipoles[channel])?;
        let step = format!("all pairs of texels, {}", CHANNELS[channel]);
        let radiosity = reference.radiosity(&values, &mut |done, rows| progress(&step, done as u64, rows as u64))?;
        found.texels.iter_mut().zip(radiosity).for_each(|(into, b)| into[channel] = b);
        for (into, &probe) in found.probes.iter_mut().zip(&parameters.probes) {
            into[channel] = reference.radiosity_at(glam::DVec3::from(probe) * parameters.mm_per_unit, &values)?;
        }
    }
    Ok(found)
}
