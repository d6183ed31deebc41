use approx::abs_diff_eq;
use crossbar_ground::sphere::{MAX_ORDER, evaluate, function_band, function_index};
use glam::DVec3;
use std::f64::consts::PI;

#[test]
fn indices_and_the_constant() {
    for index in 0..MAX_ORDER * MAX_ORDER {
        let (l, m) = function_band(index);
        assert_eq!(function_index(l, m), index);
    }
    assert!(abs_diff_eq!(evaluate(&[2.0 * PI.sqrt()], DVec3::X), 1.0, epsilon = 2e-16));
}
