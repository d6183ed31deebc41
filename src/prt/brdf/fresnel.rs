//! Fresnel reflectance as BRDF models write it: from the reflectance at normal incidence.

/// Schlick's approximation; `cosine` is that of the angle to the half vector, in [0, 1].
pub(crate) fn schlick(normal_incidence: f64, cosine: f64) -> f64 {
    normal_incidence + (1.0 - normal_incidence) * fifth_power(1.0 - cosine)
}

/// Fresnel's formula for dielectrics and unpolarised light, in the form of Cook and Torrance: the index follows from
/// the reflectance at normal incidence, below 1.
pub(crate) fn dielectric(normal_incidence: f64, cosine: f64) -> f64 {
    let root = normal_incidence.sqrt();
    let index = (1.0 + root) / (1.0 - root);
    let g = ((index - 1.0) * (index + 1.0) + cosine * cosine).sqrt();
    let (near, far) = (g - cosine, g + cosine);
    if far <= 0.0 {
        return 1.0;
    }
    let ratio = (cosine * far - 1.0) / (cosine * near + 1.0);
    0.5 * (near / far) * (near / far) * (1.0 + ratio * ratio)
}

/// x^5.
pub(super) fn fifth_power(x: f64) -> f64 {
    let square = x * x;
    square * square * x
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    #[test]
    fn reflectance_rises_from_normal_incidence_to_1() {
        for f0 in [0.0, 0.04, 0.5, 0.95] {
            for fresnel in [schlick, dielectric] {
                assert_abs_diff_eq!(fresnel(f0, 1.0), f0, epsilon = 1e-15);
                // An index of 1 reflects nothing, not even at grazing incidence.
                let grazing = if f0 == 0.0 { fresnel(f0, 0.0) } else { 1.0 };
                assert_abs_diff_eq!(fresnel(f0, 0.0), grazing, epsilon = 1e-12);
            }
        }
        // Brewster's angle of index 1.5, tan = 1.5: only one polarisation, ((n^2 - 1) / (n^2 + 1))^2 / 2.
        let brewster = dielectric(0.04, 1.0 / (1.0_f64 + 2.25).sqrt());
        assert_abs_diff_eq!(brewster, 0.5 * (1.25_f64 / 3.25) * (1.25 / 3.25), epsilon = 1e-15);
    }
}
