//! Numbers as multiples of a step.

use thiserror::Error;

/// How numbers become integers. The paper codes both in 16 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CodeOptions {
    /// Bits of a representative's number, its sign among them: 2 to 16.
    pub representative_bits: u8,
    /// Bits of a weight, its sign among them: 2 to 16.
    pub weight_bits: u8,
    /// Which numbers share a step.
    pub scale: ScaleOf,
}

/// Which numbers share a step; the paper says nothing.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::EnumIter, strum::EnumMessage)]
#[strum(serialize_all = "lowercase")]
pub enum ScaleOf {
    /// Those of a representative; the weights on it share another.
    Representative,
    /// All representatives of a segment; all weights there share another.
    Segment,
}

/// Why numbers cannot be coded so.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum CodeOptionsError {
    /// Too few or too many bits.
    #[error("expected 2 to 16 bits for {what}, the sign among them, found {found}")]
    Bits {
        /// What was to be coded.
        what: &'static str,
        /// The number asked for.
        found: u8,
    },
}

impl Default for CodeOptions {
    fn default() -> Self {
        Self { representative_bits: 16, weight_bits: 16, scale: ScaleOf::Representative }
    }
}

impl CodeOptions {
    pub(super) fn check(&self) -> Result<(), CodeOptionsError> {
        for (what, found) in [("representatives", self.representative_bits), ("weights", self.weight_bits)] {
            if !(2..=16).contains(&found) {
                return Err(CodeOptionsError::Bits { what, found });
            }
        }
        Ok(())
    }
}

/// The step with which numbers up to a magnitude fill signed integers of so many bits: a single, so that a file holds
/// it; 0 for no magnitude, and where a single holds none so small.
pub(super) fn step(largest: f64, bits: u8) -> f32 {
    let most = f64::from((1_u32 << (bits - 1)) - 1);
    let step = (largest / most) as f32;
    // A step that was rounded down would push the largest number past the last integer.
    if f64::from(step) * most < largest { step.next_up() } else { step }
}

/// The nearest multiple of a step, the even one of two as near; 0 without a step.
pub(super) fn quantise(value: f64, step: f32) -> i16 {
    if step == 0.0 { 0 } else { (value / f64::from(step)).round_ties_even() as i16 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_come_back_within_half_a_step() {
        for bits in 2..=16 {
            for largest in [1.0, 0.3, 1e-30, 7e20, 1e-44] {
                let step = step(largest, bits);
                for k in 0..=64 {
                    let value = largest * (f64::from(k) / 32.0 - 1.0);
                    let code = quantise(value, step);
                    assert!(i32::from(code).abs() < 1 << (bits - 1), "{bits} bits: {code}");
                    let back = f64::from(code) * f64::from(step);
                    // The quotient rounds by at most 2^-53 of 2^15.
                    let most = f64::from(step) * (0.5 + 1e-11);
                    assert!((back - value).abs() <= most, "{bits} bits of {largest}: {value} to {back}");
                }
            }
        }
        assert_eq!((step(0.0, 16), quantise(0.0, 0.0)), (0.0, 0));
        assert_eq!([0.5, 1.5, 2.5, -0.5].map(|value| quantise(value, 1.0)), [0, 2, 2, 0]);
    }
}
