//! Logarithm and arc tangent with the same bits everywhere: those of the standard library vary by platform.

/// The natural logarithm.
#[must_use]
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// The angle of the point (x, y) from the x axis, in radians.
#[must_use]
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bits_are_these() {
        assert_eq!(ln(2.0), std::f64::consts::LN_2);
        assert_eq!(atan2(1.0, 0.0), std::f64::consts::FRAC_PI_2);
        assert_eq!([ln(0.3).to_bits(), atan2(0.3, 0.7).to_bits()], [0xbff3_4378_fcbd_a721, 0x3fd9_e9bf_3d20_dc71]);
    }
}
