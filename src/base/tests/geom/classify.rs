use approx::assert_abs_diff_eq;
use crossbar_base::geom::ExactT;
use crossbar_base::geom::classify::t_error;
use num_bigint::BigUint;

#[test]
fn the_error_of_t_is_exact() {
    let t = ExactT::new(BigUint::from(1_u8), BigUint::from(3_u8)).expect("a fraction");
    assert_abs_diff_eq!(t_error(&t, 0.333_333_34), f64::from(0.333_333_34_f32) - 1.0 / 3.0, epsilon = 1e-16);
    assert_eq!(t_error(&t, f32::NAN), f64::INFINITY);
    assert_abs_diff_eq!(t_error(&t, -1.0), 4.0 / 3.0, epsilon = 1e-15);
    let zero = ExactT::new(BigUint::from(0_u8), BigUint::from(3_u8)).expect("a fraction");
    assert_eq!([t_error(&zero, 0.0), t_error(&zero, 1.0)], [0.0, 1.0]);
}
