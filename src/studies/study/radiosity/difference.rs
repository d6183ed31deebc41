//! Error of a solution against the direct one.

use serde::{Deserialize, Serialize};

/// Error of a solution over all patches and channels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SolutionError {
    /// Largest absolute difference, relative to the brightest patch's radiosity.
    pub largest: f64,
    /// Largest relative difference. Patches without any light are excluded.
    pub relative: f64,
    /// Mean signed relative difference over patches that do not emit: negative if the room is too dark.
    pub bias: f64,
}

impl SolutionError {
    /// Compares two solutions, one radiosity per patch.
    pub(super) fn between(found: &[[f64; 3]], reference: &[[f64; 3]], emittance: &[[f64; 3]]) -> Self {
        let brightest = reference.as_flattened().iter().copied().fold(0.0, f64::max);
        let mut error = Self::default();
        let (mut sum, mut count) = (0.0, 0.0);
        for ((found, reference), emittance) in found.iter().zip(reference).zip(emittance) {
            for c in 0..3 {
                let difference = found[c] - reference[c];
                error.largest = larger(error.largest, difference.abs() / brightest);
                if reference[c] > 0.0 {
                    error.relative = larger(error.relative, (difference / reference[c]).abs());
                    if emittance[c] == 0.0 {
                        sum += difference / reference[c];
                        count += 1.0;
                    }
                }
            }
        }
        Self { bias: if count > 0.0 { sum / count } else { 0.0 }, ..error }
    }
}

/// The maximum; NaN compares as +infinity.
fn larger(worst: f64, error: f64) -> f64 {
    if error <= worst || worst.is_nan() { worst } else { error }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lamps_and_dark_patches_do_not_count_for_the_bias() {
        let reference = [[8.0, 8.0, 8.0], [1.0, 2.0, 0.0]];
        let found = [[8.0, 4.0, 8.0], [0.5, 2.0, 0.0]];
        let emittance = [[8.0; 3], [0.0; 3]];
        let error = SolutionError::between(&found, &reference, &emittance);
        assert_eq!(error, SolutionError { largest: 0.5, relative: 0.5, bias: -0.25 });
        assert!(SolutionError::between(&[[f64::NAN; 3], [1.0; 3]], &reference, &emittance).largest.is_nan());
    }
}
