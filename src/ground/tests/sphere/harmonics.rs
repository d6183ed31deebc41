use approx::abs_diff_eq;
use crossbar_ground::sphere::{MAX_ORDER, evaluate, function_band, function_index, swap_d3dx_signs};
use glam::DVec3;
use std::f64::consts::PI;

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
