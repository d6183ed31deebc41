//! Reflectance and transmittance of a smooth boundary for unpolarised light: Fresnel's equations for dielectrics in the
//! forms that renderers and BRDF models use, and Schlick's approximation.
//!
//! [`reflectance`] is accurate where little is transmitted, [`transmittance`] where little is reflected: neither
//! suffers from cancellation there. Their sum is 1 up to rounding.

/// Fresnel reflectance of a boundary, in [0, 1]: the mean of both polarisations. `cosine` is the cosine of the angle
/// between light and normal, `ratio` the refractive index on the light's side divided by the index on the other side.
/// The result is 1 under total internal reflection.
pub fn reflectance(cosine: f64, ratio: f64) -> f64 {
    let cosine = cosine.clamp(0.0, 1.0);
    let square = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
    if square <= 0.0 {
        return 1.0;
    }
    let beyond = square.sqrt();
    let across = (ratio * cosine - beyond) / (ratio * cosine + beyond);
    let along = (cosine - ratio * beyond) / (cosine + ratio * beyond);
    (across * across + along * along) / 2.0
}

/// Fresnel transmittance of a boundary, in [0, 1]: 1 minus the mean of both polarisations' reflectances.
///
/// `eta` is the index of refraction of the far side relative to the near one: above 1 for light that enters the medium,
/// below 1 for light that leaves it. `cosine` is the cosine of the angle on the near side. The result is 0 if the
/// cosine is not above 0 (light along the surface or from behind), and under total internal reflection.
pub fn transmittance(eta: f64, cosine: f64) -> f64 {
    let c = cosine.min(1.0);
    // The square of eta times the cosine on the far side.
    let square = (eta - 1.0) * (eta + 1.0) + c * c;
    // `cosine` instead of `c`, because `min` drops NaN.
    if !(cosine > 0.0 && square > 0.0) {
        return 0.0;
    }
    let far = square.sqrt();
    let across = c + far;
    let along = eta * eta * c + far;
    // 1 - ((c - far) / across)^2 = 4 c far / across^2, and likewise for the other polarisation; this avoids
    // cancellation.
    (2.0 * c * far * (1.0 / (across * across) + (eta / along) * (eta / along))).min(1.0)
}

/// Fresnel reflectance in Cook and Torrance's form, from the reflectance at normal incidence, in [0, 1), which
/// determines the refractive index. `cosine` is in [0, 1].
pub fn dielectric(normal_incidence: f64, cosine: f64) -> f64 {
    // Without contrast, the formula leaves rounding errors.
    if normal_incidence == 0.0 {
        return 0.0;
    }
    let root = normal_incidence.sqrt();
    reflectance(cosine, (1.0 - root) / (1.0 + root))
}

/// Schlick's approximation of the Fresnel reflectance, from the reflectance at normal incidence; `cosine` is in [0, 1].
pub fn schlick(normal_incidence: f64, cosine: f64) -> f64 {
    let left = 1.0 - cosine;
    let square = left * left;
    normal_incidence + (1.0 - normal_incidence) * (square * square * left)
}
