//! Window functions: attenuation of high bands to reduce ringing.

use std::f64::consts::PI;

use super::harmonics::function_band;
use crate::elementary::sin_cos;

/// Window function: falloff of a band's factor with l.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::Display, strum::EnumIter, strum::EnumMessage)]
#[strum(serialize_all = "kebab-case")]
pub enum BandWindow {
    /// Half a cosine wave.
    ///
    /// (1 + cos(pi l / w)) / 2.
    Hann,
    /// sin(x) / x.
    ///
    /// With x = pi l / w.
    Lanczos,
}

impl BandWindow {
    /// Factor of band l: 1 for l = 0, 0 from the width w on. A window as wide as the order is usual; a narrower one
    /// rings less and blurs more.
    ///
    /// # Panics
    /// If the width is not positive.
    pub fn factor(self, l: usize, width: f64) -> f64 {
        assert!(width > 0.0, "a positive width, not {width}");
        let at = l as f64 / width;
        if at >= 1.0 {
            return 0.0;
        }
        let (sin, cos) = sin_cos(PI * at);
        match self {
            _ if l == 0 => 1.0,
            Self::Hann => 0.5 + 0.5 * cos,
            Self::Lanczos => sin / (PI * at),
        }
    }

    /// Multiplies each coefficient by the factor of its band.
    ///
    /// # Panics
    /// If the width is not positive.
    pub fn apply(self, width: f64, coefficients: &mut [f64]) {
        for (index, coefficient) in coefficients.iter_mut().enumerate() {
            *coefficient *= self.factor(function_band(index).0, width);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn windows_fall_from_1_to_0() {
        for window in [BandWindow::Hann, BandWindow::Lanczos] {
            let factors: Vec<f64> = (0..7).map(|l| window.factor(l, 5.0)).collect();
            assert!(factors[0] == 1.0 && factors[5..] == [0.0, 0.0], "{factors:?}");
            assert!(factors[..6].is_sorted_by(|a, b| a > b), "{factors:?}");
        }
        assert!((BandWindow::Hann.factor(2, 4.0) - 0.5).abs() < 1e-16);
        assert!((BandWindow::Lanczos.factor(2, 4.0) - 2.0 / PI).abs() < 1e-16);
    }
}
