//! Householder reflections.

use super::dot;

/// Squared length below which part of a vector counts as 0, if the largest element is at least 1: far below all
/// rounding errors, and its square is far above underflow.
const NEGLIGIBLE_SQUARE: f64 = 1e-60;

/// Householder reflection I - axis axis^T / half, on the first components.
pub(super) struct Reflection {
    pub(super) axis: Vec<f64>,
    pub(super) half: f64,
}

impl Reflection {
    pub(super) fn apply(&self, vector: &mut [f64]) {
        let along = dot(&self.axis, vector) / self.half;
        vector.iter_mut().zip(&self.axis).for_each(|(value, axis)| *value -= along * axis);
    }

    /// Returns the reflection that maps a vector to a multiple of the unit vector of component `at` (the first or the
    /// last), and the factor of that vector. The reflection is `None` if the other components are 0, or the whole
    /// vector counts as 0.
    pub(super) fn onto(mut axis: Vec<f64>, at: usize) -> (Option<Self>, f64) {
        let Some(&kept) = axis.get(at) else { return (None, 0.0) };
        let others = if at == 0 { &axis[1..] } else { &axis[..at] };
        let rest = dot(others, others);
        let square = rest + kept * kept;
        if rest == 0.0 || square < NEGLIGIBLE_SQUARE {
            return (None, if rest == 0.0 { kept } else { 0.0 });
        }
        let length = square.sqrt().copysign(kept);
        axis[at] += length;
        let half = length * axis[at];
        (Some(Self { axis, half }), -length)
    }
}

/// The largest of some magnitudes; NaN if one is NaN, which `f64::max` would ignore.
pub(super) fn largest(magnitudes: impl Iterator<Item = f64>) -> f64 {
    magnitudes.fold(0.0, |most, value| if most.is_nan() || value <= most { most } else { value })
}

/// Power of two whose product with a magnitude is in [1, 2); 1 for 0.
pub(super) fn inverse_power_of_two(magnitude: f64) -> f64 {
    let exponent = (magnitude.to_bits() >> 52) & 0x7ff;
    // Beyond these exponents, the inverse would not be a normal number.
    if magnitude == 0.0 { 1.0 } else { f64::from_bits((2046 - exponent.clamp(1, 2045)) << 52) }
}
