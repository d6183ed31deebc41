//! Fresnel transmittance between dielectrics, for unpolarised light, and its means over a hemisphere.

use crate::quadrature::graded_integral;

/// Intervals of the means' quadrature: the last but one begins at a cosine of 2^-52.
const PANELS: u32 = 53;

/// The fraction of light that passes the boundary, in [0, 1]: 1 less the mean of both polarisations' reflectances.
///
/// `eta` is the index of refraction of the far side relative to the near one: above 1 for light that enters the
/// medium, below 1 for light that leaves it. `cosine` is that of the angle on the near side. 0 for light that runs
/// along the surface or comes from behind it (cosine not above 0), and where it is reflected totally.
pub fn fresnel_transmittance(eta: f64, cosine: f64) -> f64 {
    let c = cosine.min(1.0);
    // The square of eta times the cosine on the far side.
    let square = (eta - 1.0) * (eta + 1.0) + c * c;
    // The cosine itself, because `min` drops NaN.
    if !(cosine > 0.0 && square > 0.0) {
        return 0.0;
    }
    let far = square.sqrt();
    let across = c + far;
    let along = eta * eta * c + far;
    // 1 - ((c - far) / across)^2 = 4 c far / across^2, and so for the other polarisation: no difference of near values.
    (2.0 * c * far * (1.0 / (across * across) + (eta / along) * (eta / along))).min(1.0)
}

/// The mean of the transmittance into a medium of index `eta` over a hemisphere of equal radiance outside: the
/// integral of 2 c F_t(c) over cosines c in [0, 1].
pub fn mean_transmittance(eta: f64) -> f64 {
    graded_integral(1.0, PANELS, |c| 2.0 * c * fresnel_transmittance(eta, c))
}

/// The diffuse reflectance F_dr of the boundary from inside, by the integral of Fresnel's formula.
///
/// What passes from outside in is, per square of the index, what passes from inside out: 1 - T / eta^2.
pub fn internal_reflectance(eta: f64) -> f64 {
    1.0 - mean_transmittance(eta) / (eta * eta)
}

/// The polynomial for F_dr that Jensen, Marschner, Levoy and Hanrahan 2001 use, for `eta` of at least 1.
pub fn internal_reflectance_polynomial(eta: f64) -> f64 {
    -1.440 / (eta * eta) + 0.710 / eta + 0.668 + 0.0636 * eta
}
