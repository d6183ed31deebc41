//! Transfer function of a display: sRGB (IEC 61966-2-1), piecewise as in the standard.

/// Encodes a linear value, clipped to [0, 1], as a byte; NaN becomes black.
pub fn encode(value: f64) -> u8 {
    (curve(clip(value)) * 255.0 + 0.5) as u8
}

/// Clips a linear value to [0, 1]; NaN becomes black.
pub fn clip(value: f64) -> f64 {
    if value > 0.0 { value.min(1.0) } else { 0.0 }
}

/// sRGB encoding of a linear value; both are in [0, 1].
pub fn curve(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * crate::elementary::pow(linear, 1.0 / 2.4) - 0.055 }
}

/// Inverse of [`curve`]: linear value of an encoded value; both are in [0, 1].
pub fn decode(value: f64) -> f64 {
    if value <= 0.040_45 { value / 12.92 } else { crate::elementary::pow((value + 0.055) / 1.055, 2.4) }
}
