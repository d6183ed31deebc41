//! How far a solution is from the truth.

/// What a solution is off by, over all patches and channels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Difference {
    /// The largest difference, of the brightest patch's radiosity.
    pub largest: f64,
    /// The largest difference of a radiosity, of itself. Patches without any light do not count.
    pub relative: f64,
    /// The mean of that over patches that do not shine, with its sign: below 0 the room is too dark.
    pub bias: f64,
}

impl Difference {
    /// Between what was found and the truth, a radiosity a patch.
    pub(super) fn between(found: &[[f64; 3]], truth: &[[f64; 3]], emittance: &[[f64; 3]]) -> Self {
        let brightest = truth.as_flattened().iter().copied().fold(0.0, f64::max);
        let mut off = Self::default();
        let (mut sum, mut count) = (0.0, 0.0);
        for ((found, truth), emittance) in found.iter().zip(truth).zip(emittance) {
            for c in 0..3 {
                let difference = found[c] - truth[c];
                off.largest = larger(off.largest, difference.abs() / brightest);
                if truth[c] > 0.0 {
                    off.relative = larger(off.relative, (difference / truth[c]).abs());
                    if emittance[c] == 0.0 {
                        sum += difference / truth[c];
                        count += 1.0;
                    }
                }
            }
        }
        Self { bias: if count > 0.0 { sum / count } else { 0.0 }, ..off }
    }
}

/// What is no number is the largest of all.
fn larger(worst: f64, off: f64) -> f64 {
    if off <= worst || worst.is_nan() { worst } else { off }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lamps_and_dark_patches_do_not_count_for_the_bias() {
        let truth = [[8.0, 8.0, 8.0], [1.0, 2.0, 0.0]];
        let found = [[8.0, 4.0, 8.0], [0.5, 2.0, 0.0]];
        let emittance = [[8.0; 3], [0.0; 3]];
        let off = Difference::between(&found, &truth, &emittance);
        assert_eq!(off, Difference { largest: 0.5, relative: 0.5, bias: -0.25 });
        assert!(Difference::between(&[[f64::NAN; 3], [1.0; 3]], &truth, &emittance).largest.is_nan());
    }
}
