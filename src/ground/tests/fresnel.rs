use approx::assert_abs_diff_eq;
use crossbar_ground::fresnel::{dielectric, reflectance, schlick, transmittance};

#[test]
fn fresnel_at_the_angles_that_have_a_name() {
    // Head on: ((n - 1) / (n + 1))^2.
    assert_abs_diff_eq!(reflectance(1.0, 1.0 / 1.5), 0.04, epsilon = 1e-15);
    assert_abs_diff_eq!(reflectance(1.0, 1.5), 0.04, epsilon = 1e-15);
    assert_eq!(reflectance(0.0, 1.0 / 1.5), 1.0);
    // Brewster's angle, tan = n: one polarisation is not reflected, the other by ((n^2 - 1) / (n^2 + 1))^2.
    let cosine = 1.0 / (1.0_f64 + 2.25).sqrt();
    let other = (1.25 / 3.25) * (1.25 / 3.25);
    assert_abs_diff_eq!(reflectance(cosine, 1.0 / 1.5), other / 2.0, epsilon = 1e-15);
    assert_abs_diff_eq!(dielectric(0.04, cosine), other / 2.0, epsilon = 1e-15);
    // Beyond the critical angle, sin = 1 / n.
    assert_eq!(reflectance(0.7, 1.5), 1.0);
    assert!(reflectance(0.8, 1.5) < 1.0);
}

#[test]
fn reflectance_and_transmittance_sum_to_1() {
    for eta in [1.0, 1.0 + 1e-9, 1.3, 1.5, 2.4, 1.0 / 1.3, 1.0 / 2.4] {
        for step in 0..=200 {
            let cosine = f64::from(step) / 200.0;
            // Light along the surface is not transmitted at any index; the quotients are 0 / 0 there.
            let reflected = if step > 0 { reflectance(cosine, 1.0 / eta) } else { 1.0 };
            assert_abs_diff_eq!(transmittance(eta, cosine) + reflected, 1.0, epsilon = 1e-12);
        }
    }
}

#[test]
fn reflectance_rises_from_normal_incidence_to_1() {
    for f0 in [0.0, 0.04, 0.5, 0.95] {
        for fresnel in [schlick, dielectric] {
            assert_abs_diff_eq!(fresnel(f0, 1.0), f0, epsilon = 1e-15);
            // At an index of 1 the boundary vanishes, and the grazing reflectance depends on the formula.
            if f0 > 0.0 {
                assert_abs_diff_eq!(fresnel(f0, 0.0), 1.0, epsilon = 1e-12);
            }
        }
    }
}
