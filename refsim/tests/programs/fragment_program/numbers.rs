//! The three precisions, special values, and operations that only OpenGL programs have.

use super::{color, one, run};
use refsim::num::{Format, ops};

#[test]
fn angles_are_radians_and_results_the_nearest() {
    // sin 1 = 0.84147098480789650665, cos 1 = 0.54030230586813971740; pi as a single is 8.7e-8 too small.
    let pi = std::f32::consts::PI;
    assert_eq!(one("SINR R0, p[0].x", [1.0; 4])[0], 0x3f57_6aa4);
    assert_eq!(one("COSR R0, p[0].x", [1.0; 4])[0], 0x3f0a_5140);
    assert_eq!(one("SINR R0, p[0].x", [pi; 4])[0], (-8.742_278e-8_f32).to_bits());
    assert_eq!(one("COSR R0, p[0].x", [pi; 4])[0], (-1.0_f32).to_bits());
    // Large angles are reduced exactly: the nearest single to 1e22 is 9999999778196308361216; its sine, by mpmath, is
    // -0.73408153529610.
    assert_eq!(one("SINR R0, p[0].x", [1.0e22; 4])[0], 0xbf3b_ecc4);
}

#[test]
fn sines_and_cosines_obey_their_identities_in_any_format() {
    for text in ["e8m23", "e7m16", "e5m10", "s3.12", "e8m23:rtz"] {
        let format: Format = text.parse().unwrap();
        for k in -40..40_i32 {
            let angle = refsim::num::from_ratio(format, k < 0, k.unsigned_abs().into(), 7).bits;
            let minus = ops::neg(format, angle).bits;
            let cos = ops::cos(format, angle).bits;
            assert_eq!(cos, ops::cos(format, minus).bits, "{text} {k}: even");
            let sin = ops::sin(format, angle).bits;
            assert_eq!(ops::neg(format, sin).bits, ops::sin(format, minus).bits, "{text} {k}: odd");
            let number = |bits| f64::from(f32::from_bits(ops::convert(&format, Format::FP32, bits).bits));
            let circle = number(cos) * number(cos) + number(sin) * number(sin);
            let step = if format.width() > 16 { 1e-4 } else { 2e-3 };
            assert!((circle - 1.0).abs() < step, "{text} {k}: {circle}");
        }
    }
}

#[test]
fn reflection_and_the_two_dimensional_matrix() {
    // Reflection about (0, 2, 0): (1, 1, 0) becomes (-1, 1, 0).
    let ran = run("MOVR R1, {0, 2, 0, 7}; RFLR R0.xyz, R1, p[0];", &[[1.0, 1.0, 0.0, 5.0]]);
    assert_eq!(color(&ran)[..3], [-1.0, 1.0, 0.0]);
    let ran = run("MOVR R1, {2, 3, 0, 0}; MOVR R2, {10, 20, 30, 40}; X2DR R0, p[0], R1, R2;", &[[1.0, 2.0, 0.0, 0.0]]);
    assert_eq!(color(&ran), [81.0, 182.0, 81.0, 182.0]);
}

#[test]
fn dst_is_that_of_the_specification() {
    let ran = run("MOVR R1, {9, 3, 4, 9}; DSTR R0, R1, p[0];", &[[9.0, 0.5, 9.0, 0.25]]);
    assert_eq!(color(&ran), [1.0, 1.5, 4.0, 0.25]);
}
