use crossbar_base::elementary::{atan2, ln, on_circle};

#[test]
fn quarters_are_exact_and_the_bits_are_these() {
    assert_eq!(
        [0.0, 0.25, 0.5, 0.75, -0.25, 5.25].map(on_circle).map(|at| at.map(|value| value + 0.0)),
        [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0], [0.0, -1.0], [0.0, 1.0],]
    );
    assert_eq!(on_circle(1.0 / 12.0).map(f64::to_bits), [0x3feb_b67a_e858_4cab, 0x3fdf_ffff_ffff_ffff]);
    assert_eq!(ln(2.0), std::f64::consts::LN_2);
    assert_eq!(atan2(1.0, 0.0), std::f64::consts::FRAC_PI_2);
    assert_eq!([ln(0.3).to_bits(), atan2(0.3, 0.7).to_bits()], [0xbff3_4378_fcbd_a721, 0x3fd9_e9bf_3d20_dc71]);
}
