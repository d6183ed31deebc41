//! Error of a solution compared with the direct one.

use crate::picture::metrics::{ErrorSums, value_error};

/// Error of a solution over all patches and channels. Errors are infinite where a radiosity is not finite and the
/// direct one is, or the reverse.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::study) struct SolutionError {
    /// Largest absolute difference, relative to the brightest patch's radiosity.
    pub(in crate::study) largest: f64,
    /// Largest relative difference. Patches without any light are excluded.
    pub(in crate::study) relative: f64,
    /// Largest relative difference over patches that do not emit.
    pub(in crate::study) relative_unlit: f64,
    /// Mean signed relative difference over patches that do not emit, each with the same weight: negative if they are
    /// too dark.
    pub(in crate::study) bias: f64,
    /// Number of radiosities that are not finite where the direct ones are, or the reverse.
    pub(in crate::study) not_finite: u64,
}

impl SolutionError {
    pub(in crate::study) fn between(found: &[[f64; 3]], reference: &[[f64; 3]], emittance: &[[f64; 3]]) -> Self {
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
