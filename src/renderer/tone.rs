//! From linear light to the bytes of a display.

use crate::elementary::pow;

/// The byte of a linear value: the sRGB curve (IEC 61966-2-1), clipped to [0, 1].
pub fn srgb(value: f64) -> u8 {
    // NaN becomes black.
    let linear = if value > 0.0 { value.min(1.0) } else { 0.0 };
    let curved = if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * pow(linear, 1.0 / 2.4) - 0.055 };
    (curved * 255.0 + 0.5) as u8
}

/// Red, green, blue bytes of a picture: each radiance times `exposure`, through the sRGB curve. What is brighter than 1
/// is clipped.
pub fn bytes(color: &[[f64; 3]], exposure: f64) -> Vec<u8> {
    color.iter().flat_map(|pixel| pixel.map(|channel| srgb(channel * exposure))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_at_points_that_are_known() {
        let known = [(0.0, 0), (1.0, 255), (7.0, 255), (-1.0, 0), (f64::NAN, 0), (0.215_860_5, 128), (0.5, 188)];
        for (linear, byte) in known {
            assert_eq!(srgb(linear), byte, "{linear}");
        }
        assert_eq!(bytes(&[[0.25, 0.5, 1.0]], 2.0), [188, 255, 255]);
    }
}
