//! Error of a solution against the direct one.

use serde::{Deserialize, Serialize};

use crate::picture::metrics::{ErrorSums, value_error};

/// Error of a solution over all patches and channels. Errors are infinite where a radiosity is not finite and the
/// direct one is, or the reverse.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SolutionError {
    /// Largest absolute difference, relative to the brightest patch's radiosity.
    pub largest: f64,
    /// Largest relative difference. Patches without any light are excluded.
    pub relative: f64,
    /// Largest relative difference over patches that do not emit.
    pub relative_unlit: f64,
    /// Mean signed relative difference over patches that do not emit, large and small alike: negative if they are too
    /// dark.
    pub bias: f64,
    /// Number of radiosities that are not finite where the direct ones are, or the reverse.
    pub not_finite: u64,
}

impl SolutionError {
    /// Compares two solutions, one radiosity per patch.
    pub(super) fn between(found: &[[f64; 3]], reference: &[[f64; 3]], emittance: &[[f64; 3]]) -> Self {
        let brightest = reference.as_flattened().iter().copied().filter(|b| b.is_finite()).fold(0.0, f64::max);
        let [mut absolute, mut relative, mut unlit] = [ErrorSums::default(); 3];
        for ((found, reference), emittance) in found.iter().zip(reference).zip(emittance) {
            for c in 0..3 {
                let difference = value_error(found[c], reference[c]);
                absolute.add(difference, 1.0);
                if reference[c] > 0.0 {
                    let share = if difference.is_finite() { difference / reference[c] } else { difference };
                    relative.add(share, 1.0);
                    if emittance[c] == 0.0 {
                        unlit.add(share, 1.0);
                    }
                }
            }
        }
        Self {
            largest: if absolute.largest > 0.0 { absolute.largest / brightest } else { 0.0 },
            relative: relative.largest,
            relative_unlit: unlit.largest,
            bias: unlit.mean(),
            not_finite: absolute.not_finite,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lamps_and_dark_patches_do_not_count_for_the_bias() {
        let reference = [[8.0, 8.0, 8.0], [1.0, 2.0, 0.0]];
        let found = [[8.0, 2.0, 8.0], [0.5, 2.0, 0.0]];
        let emittance = [[8.0; 3], [0.0; 3]];
        let error = SolutionError::between(&found, &reference, &emittance);
        let expected = SolutionError { largest: 0.75, relative: 0.75, relative_unlit: 0.5, bias: -0.25, not_finite: 0 };
        assert_eq!(error, expected);
        let error = SolutionError::between(&[[8.0; 3], [f64::NAN, f64::INFINITY, 0.0]], &reference, &emittance);
        assert_eq!((error.not_finite, error.relative_unlit, error.bias), (2, f64::INFINITY, f64::INFINITY));
    }
}
