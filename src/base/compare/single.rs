//! Distance between two f32 numbers, and the text of a number.

use std::fmt::{Display, LowerExp};

/// Number of f32 steps between two numbers. -0 and +0 are 0 steps apart, and so are two NaN. `None` if the numbers are
/// not equal and one is NaN or infinite.
pub fn f32_ulps(left: f32, right: f32) -> Option<u64> {
    if left == right || (left.is_nan() && right.is_nan()) {
        return Some(0);
    }
    let step = |x: f32| {
        let magnitude = i64::from(x.to_bits() & 0x7fff_ffff);
        if x.is_sign_negative() { -magnitude } else { magnitude }
    };
    (left.is_finite() && right.is_finite()).then(|| step(left).abs_diff(step(right)))
}

/// Shortest text that reads back to the same number, with an exponent if the number is far from 1.
pub(crate) fn shortest(number: impl Into<f64> + Copy + Display + LowerExp) -> String {
    let real: f64 = number.into();
    let plain = real == 0.0 || !real.is_finite() || (f64::from(1e-4_f32)..1e9).contains(&real.abs());
    if plain { format!("{number}") } else { format!("{number:e}") }
}
