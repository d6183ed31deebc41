//! Quantisation: numbers as integer multiples of a step.

use serde::{Deserialize, Serialize};

use crate::error::{InputError, ensure};

/// Options of the quantisation. The paper uses 16 bits for both.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct CodeOptions {
    /// Bits of a representative's numbers, including the sign: 2 to 16.
    pub representative_bits: u8,
    /// Bits of a weight, including the sign: 2 to 16.
    pub weight_bits: u8,
    /// The numbers that share a step.
    pub scale: ScaleOf,
}

/// The numbers that share a step, which the paper leaves open.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ScaleOf {
    /// Each representative has a step, and the weights of that representative have another.
    Representative,
    /// All representatives of a segment share a step, and all its weights another.
    Segment,
}

impl Default for CodeOptions {
    fn default() -> Self {
        Self { representative_bits: 16, weight_bits: 16, scale: ScaleOf::Representative }
    }
}

impl CodeOptions {
    pub(super) fn check(&self) -> Result<(), InputError> {
        for (what, found) in [("representatives", self.representative_bits), ("weights", self.weight_bits)] {
            ensure!((2..=16).contains(&found), "crossbar::prt::code" =>
                "expected 2 to 16 bits for {what}, the sign among them, found {found}");
        }
        Ok(())
    }
}

/// The step, an f32 as in files, that maps numbers up to `largest` to signed integers of `bits` bits; 0 if `largest` is
/// 0 or the step underflows.
pub(super) fn step(largest: f64, bits: u8) -> f32 {
    let most = f64::from((1_u32 << (bits - 1)) - 1);
    let step = (largest / most) as f32;
    // A step rounded down would let the largest number exceed the largest integer.
    if f64::from(step) * most < largest { step.next_up() } else { step }
}

/// The nearest multiple of a step, ties to even; 0 if the step is 0.
pub(super) fn quantise(value: f64, step: f32) -> i16 {
    if step == 0.0 { 0 } else { (value / f64::from(step)).round_ties_even() as i16 }
}
