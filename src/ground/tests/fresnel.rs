use approx::assert_abs_diff_eq;
use crossbar_ground::fresnel::{dielectric, reflectance};

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
