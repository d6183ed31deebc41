//! Operations of the scalar executor with results that can be checked by hand.

use crate::running::{bits, constants, ideal, run, run_vertex};
use refsim::exec::Constants;

#[test]
fn sincos_is_the_half_angle_series() {
    let first = [-1.550_099_2e-6, -2.170_139e-5, 0.002_604_166_7, 2.604_166_8e-4];
    let second = [-0.020_833_334, -0.125, 1.0, 0.5];
    let profile = ideal("e8m23");
    for x in [-3.1f32, -1.0, -0.25, 0.0, 0.5, 1.5, 3.0] {
        let text = "ps_2_0\nmov r0, c2\nsincos r1.xy, r0.x, c0, c1\nmov r0.xy, r1\nmov oC0, r0";
        // c0 and c1 hold the coefficients: two constants in one instruction.
        let ran = run(text, &profile, &[first, second, [x, 0.0, 0.0, 0.0]]);
        let [cos, sin, ..] = ran.value(1).map(f32::from_bits);
        // Direct3D promises an error of at most 0.002; the series itself is worst at pi.
        assert!((cos * cos + sin * sin - 1.0).abs() < 4e-3, "{x}: {cos} {sin}");
        if x == 0.0 {
            assert_eq!((cos, sin), (1.0, 0.0));
        }
        if x == 0.5 {
            assert!((cos - 0.877_582_6).abs() < 1e-6 && (sin - 0.479_425_55).abs() < 1e-6, "{cos} {sin}");
        }
        if x == 3.0 {
            assert!((cos + 0.989_992_5).abs() < 2e-3 && (sin - 0.141_120).abs() < 2e-3, "{cos} {sin}");
        }
    }
}

#[test]
fn nrm_of_a_zero_vector_is_zero() {
    for format in ["s3.12", "e5m10", "e8m23"] {
        let profile = ideal(format);
        let text = "ps_2_0\nmov r0, c0\nnrm r1, r0\nmov oC0, r1";
        assert_eq!(run(text, &profile, &[[0.0; 4]]).value(1), [0; 4], "{format}");
    }
}

#[test]
fn vertex_operations() {
    let profile = ideal("e8m23");
    let vs = |body: &str, values: &[[f32; 4]]| {
        let text = format!("vs_1_1\ndcl_position v0\ndcl_normal v1\nmov oPos, v0\n{body}");
        run_vertex(&text, &profile, &Constants::default(), values).vertex.texcoords[0]
    };
    let (a, b) = ([0.5, -2.0, 3.0, 4.0], [0.5, 1.0, -3.0, 2.0]);
    assert_eq!(vs("dst oT0, v0, v1", &[a, b]), bits([1.0, -2.0, 3.0, 2.0]));
    assert_eq!(vs("mul oT0, v0, -v1.wzyx", &[a, b]), bits([-1.0, -6.0, -3.0, -2.0]));
}

#[test]
fn m4x4_transforms_rows_by_columns() {
    let profile = ideal("e8m23");
    let rows = [[1.0, 2.0, 3.0, 4.0], [0.0, 1.0, 0.0, 5.0], [0.5, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
    let text = "vs_1_1\ndcl_position v0\nm4x4 oPos, v0, c0";
    let result = run_vertex(text, &profile, &constants(&rows), &[[1.0, 2.0, 3.0, 1.0]]);
    assert_eq!(result.vertex.position, bits([18.0, 7.0, 0.5, 1.0]));
    assert_eq!(result.slots, 4, "a matrix product costs its rows");
}

#[test]
fn relative_addresses_reach_their_constant_and_zero_beyond() {
    let profile = ideal("e8m23");
    let values: Vec<[f32; 4]> = (0..10).map(|i| [i as f32; 4]).collect();
    let text = "vs_1_1\ndcl_position v0\nmov a0.x, v0.x\nmov oT0, c[a0.x + 2]\nmov oPos, v0";
    let at = |x: f32| {
        let result = run_vertex(text, &profile, &constants(&values), &[[x, 0.0, 0.0, 1.0]]);
        f32::from_bits(result.vertex.texcoords[0][0])
    };
    // mov to a0 in vs_1_1 rounds down.
    for (x, expected) in [
        (0.0, 2.0),
        (3.9, 5.0),
        (-1.5, 0.0),
        (-2.0, 0.0),
        (-3.0, 0.0),
        (7.0, 9.0),
        (8.0, 0.0),
        (1e30, 0.0),
        (f32::NAN, 2.0),
    ] {
        assert_eq!(at(x), expected, "{x}");
    }
    let nearest = "vs_2_0\ndcl_position v0\nmova a0.y, v0.x\nmov oT0, c[a0.y + 2]\nmov oPos, v0";
    let result = run_vertex(nearest, &profile, &constants(&values), &[[3.9, 0.0, 0.0, 1.0]]);
    assert_eq!(f32::from_bits(result.vertex.texcoords[0][0]), 6.0, "mova rounds to nearest");
}
