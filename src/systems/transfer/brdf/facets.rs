//! Factors of microfacet models: distribution of normals, and shadowing and masking.
//!
//! Distributions are pi times the usual ones: multiplied by the cosine, they integrate to pi over the hemisphere.

use glam::DVec3;

use crate::elementary::exp;

/// Beckmann's distribution, isotropic, times pi: e^(-tan^2 / m^2) / (m^2 cos^4) of the angle between half vector and
/// normal, whose cosine is above 0.
pub(crate) fn beckmann(half_cosine: f64, roughness: f64) -> f64 {
    let square = half_cosine * half_cosine;
    let slope = (1.0 - square) / (square * roughness * roughness);
    exp(-slope) / (roughness * roughness * square * square)
}

/// Shadowing by V-grooves (Torrance and Sparrow 1967): `least` is the smaller cosine of view and light, `cosine` the
/// cosine of the angle between view and half vector.
pub(crate) fn groove(half_cosine: f64, least: f64, cosine: f64) -> f64 {
    (2.0 * half_cosine * least / cosine).min(1.0)
}

/// Schlick's zenith factor Z(t) = r / (1 + r t^2 - t^2)^2: the distribution times pi of an isotropic surface.
pub(crate) fn schlick_zenith(half_cosine: f64, roughness: f64) -> f64 {
    let square = half_cosine * half_cosine;
    let base = 1.0 + roughness * square - square;
    roughness / (base * base)
}

/// Schlick's azimuth factor A(w) = sqrt(p / (p^2 - p^2 w^2 + w^2)). Its mean over all azimuths is 1 for p = 1, and
/// smaller for other p.
pub(crate) fn schlick_azimuth(w: f64, isotropy: f64) -> f64 {
    let square = isotropy * isotropy;
    (isotropy / (square - square * w * w + w * w)).sqrt()
}

/// Schlick's G(v) = v / (r - r v + v), the visible fraction of the facets that face a direction.
pub(crate) fn schlick_seen(cosine: f64, roughness: f64) -> f64 {
    cosine / (roughness - roughness * cosine + cosine)
}

/// The squared sine of the angle to the normal below which a half vector counts as the normal; rounding of two mirror
/// directions gives about 1e-32.
const NORMAL: f64 = 1e-24;

/// Schlick's w: the cosine of the angle between the tangent x and the half vector's projection onto the surface; 1 for
/// the normal, which has no projection.
pub(crate) fn cosine_along_tangent(half: DVec3) -> f64 {
    let square = half.x * half.x + half.y * half.y;
    if square > NORMAL { half.x / square.sqrt() } else { 1.0 }
}
