use approx::abs_diff_eq;
use crossbar_ground::sphere::{MAX_ORDER, evaluate, function_band, function_index, harmonics, swap_d3dx_signs};
use glam::DVec3;
use std::f64::consts::PI;

#[test]
fn the_first_three_bands_are_the_known_polynomials() {
    let v = DVec3::new(2.0, -3.0, 6.0) / 7.0;
    let mut found = [0.0; 9];
    harmonics(3, v, &mut found);
    let [one, two] = [(3.0 / (4.0 * PI)).sqrt(), (15.0 / (4.0 * PI)).sqrt()];
    let expected = [
        (1.0 / (4.0 * PI)).sqrt(),
        one * v.y,
        one * v.z,
        one * v.x,
        two * v.x * v.y,
        two * v.y * v.z,
        two / 12f64.sqrt() * (3.0 * v.z * v.z - 1.0),
        two * v.x * v.z,
        two / 2.0 * (v.x * v.x - v.y * v.y),
    ];
    for (index, (found, expected)) in found.iter().zip(expected).enumerate() {
        assert!(abs_diff_eq!(*found, expected, epsilon = 2e-16), "{index}: {found} {expected}");
    }
}

#[test]
fn indices_and_signs() {
    for index in 0..MAX_ORDER * MAX_ORDER {
        let (l, m) = function_band(index);
        assert_eq!(function_index(l, m), index);
    }
    let mut coefficients = [1.0; 9];
    swap_d3dx_signs(&mut coefficients);
    assert_eq!(coefficients, [1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0]);
    assert!(abs_diff_eq!(evaluate(&[2.0 * PI.sqrt()], DVec3::X), 1.0, epsilon = 2e-16));
}
