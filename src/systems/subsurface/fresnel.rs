//! Fresnel transmittance between dielectrics, for unpolarised light, and its means over a hemisphere.

pub use crate::fresnel::transmittance as fresnel_transmittance;
use crate::quadrature::graded_integral;

/// Intervals of the quadrature of means; the last but one begins at a cosine of 2^-52.
const PANELS: u32 = 53;

/// The mean transmittance into a medium under equal radiance: the integral of 2 c F_t(c) over cosines c in [0, 1].
pub fn mean_transmittance(eta: f64) -> f64 {
    graded_integral(1.0, PANELS, |c| 2.0 * c * fresnel_transmittance(eta, c))
}

/// The diffuse reflectance F_dr of the boundary from inside, by integrating Fresnel's formula.
///
/// The mean transmittance outwards is the mean transmittance T inwards divided by eta^2, so F_dr = 1 - T / eta^2.
pub fn internal_reflectance(eta: f64) -> f64 {
    1.0 - mean_transmittance(eta) / (eta * eta)
}

/// The polynomial for F_dr that Jensen, Marschner, Levoy and Hanrahan 2001 use, for `eta` of at least 1.
pub fn internal_reflectance_polynomial(eta: f64) -> f64 {
    -1.440 / (eta * eta) + 0.710 / eta + 0.668 + 0.0636 * eta
}
