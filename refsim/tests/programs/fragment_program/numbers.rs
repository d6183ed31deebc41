//! The three precisions, special values, and operations that only OpenGL programs have.

use super::{INF, NAN, color, nv35, one, run};
use refsim::num::{Format, ops};

fn f(v: [f32; 4]) -> [u32; 4] {
    v.map(f32::to_bits)
}

#[test]
fn every_fx12_number_passes_through_x_and_half_way_numbers_round_to_even() {
    for k in (-2048..2048_i32).step_by(4) {
        let value = [0, 1, 2, 3].map(|i| (k + i) as f32 / 1024.0);
        assert_eq!(one("MOVX R0, p[0]", value).map(f32::from_bits), value);
        let between = value.map(|v| v + 0.5 / 1024.0);
        let want = [0, 1, 2, 3].map(|i: i32| {
            let n = k + i;
            let even = if n & 1 == 0 { n } else { n + 1 };
            even.min(2047) as f32 / 1024.0
        });
        assert_eq!(one("MOVX R0, p[0]", between).map(f32::from_bits), want, "{k}");
    }
}

#[test]
fn fx12_saturates_and_has_no_nan() {
    let top = 2047.0 / 1024.0;
    assert_eq!(one("MOVX R0, p[0]", [2.0, -2.0, -7.0, f32::NAN]), f([top, -2.0, -2.0, 0.0]));
    assert_eq!(one("ADDX R0, p[0], p[0]", [1.5, -1.5, 0.5, f32::INFINITY]), f([top, -2.0, 1.0, top]));
    // 2 is converted to 2047/1024 after negation, while -2 is representable.
    assert_eq!(one("MOVX R0, -p[0]", [2.0, -2.0, 0.5, 0.0]), f([-2.0, top, -0.5, 0.0]));
}

#[test]
fn every_half_passes_through_h() {
    let half = nv35().rules.partial.unwrap();
    let single = nv35().rules.format;
    for base in (0..0x1_0000_u32).step_by(16) {
        let patterns = [0, 4, 8, 12].map(|first| [0, 1, 2, 3].map(|i| base + first + i));
        let value = patterns.map(|p| p.map(|h| f32::from_bits(ops::convert(&half, single, h).bits)));
        let ran = run("MOVH H0, p[0]; MOVH H1, p[1]; MOVH H2, p[2]; MOVH H3, p[3];", &value);
        for (at, want) in patterns.iter().enumerate() {
            let clean = |h| if half.is_nan(h) { half.canonical_nan().unwrap() } else { h };
            assert_eq!(ran.value(at), want.map(clean));
        }
    }
}

#[test]
fn halves_overflow_at_two_to_the_sixteenth() {
    let ran = run("MOVH H0, p[0];", &[[65_504.0, 65_520.0, 65_535.0, 65_536.0]]);
    assert_eq!(ran.value(0), [0x7bff, 0x7bff, 0x7bff, 0x7c00]);
    // Subnormal halves exist; subnormal singles do not.
    let ran = run("MOVH H0, p[0]; ADDR R0, p[0], p[0];", &[[5.960_464_5e-8, 1.0e-39, -1.0e-39, 0.0]]);
    assert_eq!(ran.value(0), [1, 0, 0x8000, 0]);
    assert_eq!(ran.value(1)[1..3], [0, 0x8000_0000]);
}

#[test]
fn special_values_are_those_of_the_extension() {
    let scalar = |name: &str, x: f32| one(&format!("{name}R R0, p[0].x"), [x; 4])[0];
    assert_eq!(scalar("RCP", 0.0), INF);
    assert_eq!(scalar("RCP", -0.0), INF | 1 << 31);
    assert_eq!(scalar("RSQ", 0.0), INF);
    assert_eq!(scalar("RSQ", -0.0), INF | 1 << 31);
    assert_eq!(scalar("RSQ", -1.0), NAN);
    assert_eq!(scalar("LG2", 0.0), INF | 1 << 31);
    assert_eq!(scalar("LG2", -1.0), NAN);
    assert_eq!(scalar("EX2", f32::NEG_INFINITY), 0);
    assert_eq!(one("POWR R0, p[0].x, p[0].x", [0.0; 4])[0], NAN);
    assert_eq!(one("MULR R0, p[0], p[0].yxwz", [0.0, f32::INFINITY, 1.0, 2.0])[..2], [NAN, NAN]);
    assert_eq!(one("MINR R0, p[0], p[0].yxwz", [f32::NAN, 1.0, 1.0, 2.0]), [NAN, NAN, f([1.0; 4])[0], f([1.0; 4])[0]]);
    assert_eq!(one("MAXR R0, p[0], p[0].yxwz", [f32::NAN, 1.0, 1.0, 2.0]), [NAN, NAN, f([2.0; 4])[0], f([2.0; 4])[0]]);
    assert_eq!(one("ADDR R0, p[0], -p[0]", [f32::INFINITY, 1.0, 0.0, -0.0]), [NAN, 0, 0, 0]);
}

#[test]
fn sets_are_one_or_zero() {
    let value = [1.0, 2.0, f32::NAN, 0.0];
    let other = "{1.0, 1.0, 1.0, 1.0}";
    for (name, want) in [
        ("SEQ", [1.0, 0.0, 0.0, 0.0]),
        ("SNE", [0.0, 1.0, 1.0, 1.0]),
        ("SGT", [0.0, 1.0, 0.0, 0.0]),
        ("SGE", [1.0, 1.0, 0.0, 0.0]),
        ("SLT", [0.0, 0.0, 0.0, 1.0]),
        ("SLE", [1.0, 0.0, 0.0, 1.0]),
        ("STR", [1.0; 4]),
        ("SFL", [0.0; 4]),
    ] {
        let ran = run(&format!("MOVR R1, p[0]; {name}H R0, R1, {other};"), &[value]);
        assert_eq!(color(&ran), want, "{name}");
    }
}

#[test]
fn floors_and_fractions_go_down() {
    assert_eq!(one("FLRR R0, p[0]", [1.5, -1.5, -0.0, 3.0]), f([1.0, -2.0, -0.0, 3.0]));
    assert_eq!(one("FRCR R0, p[0]", [1.5, -1.25, 0.0, 3.0]), f([0.5, 0.75, 0.0, 0.0]));
    assert_eq!(one("FLRX R0, p[0]", [1.5, -1.5, 0.25, -0.25]), f([1.0, -2.0, 0.0, -1.0]));
}

#[test]
fn angles_are_radians_and_results_the_nearest() {
    // sin 1 = 0.84147098480789650665, cos 1 = 0.54030230586813971740; pi as a single is 8.7e-8 too small.
    let pi = std::f32::consts::PI;
    assert_eq!(one("SINR R0, p[0].x", [1.0; 4])[0], 0x3f57_6aa4);
    assert_eq!(one("COSR R0, p[0].x", [1.0; 4])[0], 0x3f0a_5140);
    assert_eq!(one("SINR R0, p[0].x", [pi; 4])[0], (-8.742_278e-8_f32).to_bits());
    assert_eq!(one("COSR R0, p[0].x", [pi; 4])[0], (-1.0_f32).to_bits());
    assert_eq!(one("SINR R0, p[0].x", [-0.0; 4])[0], 1 << 31);
    assert_eq!(one("COSR R0, p[0].x", [0.0; 4])[0], 1.0_f32.to_bits());
    assert_eq!(one("COSR R0, p[0].x", [f32::INFINITY; 4])[0], NAN);
    // Large angles are reduced exactly: sin 1e22 = -0.8522008497671888.
    assert_eq!(one("SINR R0, p[0].x", [1.0e22; 4])[0], ops::sin(Format::FP32, 1.0e22_f32.to_bits()).bits);
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
fn lit_and_dst_are_those_of_the_specification() {
    assert_eq!(one("LITR R0, p[0]", [0.5, 2.0, 0.0, 3.0]), f([1.0, 0.5, 8.0, 1.0]));
    assert_eq!(one("LITR R0, p[0]", [-0.5, 2.0, 0.0, 3.0]), f([1.0, 0.0, 0.0, 1.0]));
    let ran = run("MOVR R1, {9, 3, 4, 9}; DSTR R0, R1, p[0];", &[[9.0, 0.5, 9.0, 0.25]]);
    assert_eq!(color(&ran), [1.0, 1.5, 4.0, 0.25]);
}
