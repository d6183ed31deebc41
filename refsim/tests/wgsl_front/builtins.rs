//! Tests functions and statements against doubles of the host.

#![expect(
    clippy::disallowed_methods,
    reason = "the host's functions are compared within an error, whatever their last bit"
)]

use super::drawn::{SIDE, drawn};

/// The value of an expression of `a` and `b`.
type Value = fn(f64, f64) -> f64;

/// `a` and `b` of a pixel, both exact in single precision: -2 to 2, and 1/4 to 3.
fn inputs(index: usize) -> [f64; 2] {
    let side = SIDE as usize;
    let [u, v] = [index % side, index / side].map(|at| (at as f64 + 0.5) / side as f64);
    [u * 4.0 - 2.0, v * 2.75 + 0.25]
}

/// A shader whose red channel is an expression of `a` and `b`.
fn shader(before: &str, expression: &str) -> String {
    format!(
        "{before}\n@fragment fn main(@location(0) uv: vec2f) -> @location(0) vec4f {{\n\
         let a = uv.x * 4.0 - 2.0;\n let b = uv.y * 2.75 + 0.25;\n return vec4f({expression}, 0.0, 0.0, 1.0);\n}}"
    )
}

/// Compares an expression with doubles; the error may be `steps` times 2^-24 of the larger of 1 and the value's
/// magnitude.
fn holds(text: &str, name: &str, steps: f64, expected: impl Fn(f64, f64) -> f64) {
    for (index, pixel) in drawn(text, &[]).iter().enumerate() {
        let [a, b] = inputs(index);
        let expected = expected(a, b);
        let allowed = steps * 2f64.powi(-24) * expected.abs().max(1.0);
        let alike = pixel[0] == expected || (pixel[0] - expected).abs() <= allowed;
        assert!(alike || (pixel[0].is_nan() && expected.is_nan()), "{name} of {a}, {b}: {}, not {expected}", pixel[0]);
    }
}

/// Tests the functions for which [`super::accuracy`] has no row.
pub(crate) fn functions_compute_their_formulas() {
    type Row = (&'static str, f64, Value);
    let table: &[Row] = &[
        // Negative numbers lie outside the domain.
        ("sqrt(a)", 3.0, |a, _| a.sqrt()),
        ("inverseSqrt(a)", 2.0, |a, _| 1.0 / a.sqrt()),
        ("log2(a)", 2.0, |a, _| a.log2()),
        ("pow(a, 2.0)", 16.0, |a, _| if a < 0.0 { f64::NAN } else { a * a }),
        ("a % b", 8.0, |a, b| a - b * (a / b).trunc()),
        ("select(a, b, a < b)", 0.0, |a, b| if a < b { b } else { a }),
        ("f32(any(vec2f(a, b) > vec2f(1.0, 2.0)))", 0.0, |a, b| f64::from(a > 1.0 || b > 2.0)),
        ("f32(all(vec2f(a, b) > vec2f(1.0, 2.0)))", 0.0, |a, b| f64::from(a > 1.0 && b > 2.0)),
        ("f32((a < 0.0) == (b < 1.0))", 0.0, |a, b| f64::from((a < 0.0) == (b < 1.0))),
        ("(mat2x2f(1.0, 2.0, 3.0, 4.0) * vec2f(a, b)).y", 6.0, |a, b| 2.0 * a + 4.0 * b),
        ("(vec2f(a, b) * mat2x2f(1.0, 2.0, 3.0, 4.0)).y", 6.0, |a, b| 3.0 * a + 4.0 * b),
        ("(mat2x2f(a, b, 1.0, 2.0) * mat2x2f(1.0, a, 3.0, b))[1].x", 6.0, |a, b| a * 3.0 + b),
        ("transpose(mat2x3f(a, b, 1.0, 2.0, 3.0, 4.0))[1].y", 0.0, |_, _| 3.0),
        ("(2.0 * mat2x2f(a, b, 1.0, 2.0) + mat2x2f(b, a, a, b))[0].y", 2.0, |a, b| 2.0 * b + a),
        ("array<f32, 3>(a, b, 7.0)[1]", 0.0, |_, b| b),
        ("quantizeToF16(b)", 0.0, |_, b| {
            let unit = 2f64.powi(b.log2().floor() as i32 - 10);
            (b / unit).round_ties_even() * unit
        }),
    ];
    for (expression, steps, expected) in table {
        holds(&shader("", expression), expression, *steps, expected);
    }
}

pub(crate) fn control_flow_keeps_the_values_of_each_fragment() {
    let rows: [(&str, &str, Value); 9] = [
        // Division by zero gives the dividend, with remainder 0; the magnitude of the smallest i32 is that i32 itself.
        (
            "fn f() -> f32 { var zero = 0; var least = -2147483647 - 1;\n\
             return f32(7 / zero + 7 % zero + abs(least) / 65536); }",
            "f()",
            |_, _| 7.0 - 32768.0,
        ),
        (
            "fn f(a: f32, b: f32) -> f32 { if (a < 0.0) { return b; } if (b < 1.0) { return 7.0; } return a; }",
            "f(a, b)",
            |a, b| {
                if a < 0.0 {
                    b
                } else if b < 1.0 {
                    7.0
                } else {
                    a
                }
            },
        ),
        (
            "fn f(a: f32, b: f32) -> f32 { var n = 0.0; for (var i = 0; i < 8; i++) { if (f32(i) > a * 4.0) { break; } \
          if (f32(i) < b) { continue; } n += 1.0; } return n; }",
            "f(a, b)",
            |a, b| (0..8).map(f64::from).take_while(|i| *i <= a * 4.0).filter(|i| *i >= b).count() as f64,
        ),
        (
            "fn f(a: f32) -> f32 { var x = a; var i = 0; loop { if (x > 1.0) { return x; } x += 0.5; \
          continuing { i++; break if i == 3; } } return -x; }",
            "f(a)",
            |a, _| {
                let mut x = a;
                for _ in 0..3 {
                    if x > 1.0 {
                        return x;
                    }
                    x += 0.5;
                }
                -x
            },
        ),
        (
            "fn f(a: f32) -> f32 { var x = 0.0; for (var i = 0; i < 4; i++) { switch i { case 1: { x += a; } \
          case 2, 3: { if (a > 0.0) { continue; } x += 10.0; } default: { x += 1.0; } } x += 100.0; } return x; }",
            "f(a)",
            |a, _| 201.0 + a + if a > 0.0 { 0.0 } else { 220.0 },
        ),
        (
            "fn swap(a: ptr<function, vec2f>) { let t = (*a).x; (*a).x = (*a).y; if (t > 0.0) { (*a).y = t; } }\n\
          fn f(a: f32, b: f32) -> f32 { var v = vec2f(a, b); swap(&v); return v.x + 8.0 * v.y; }",
            "f(a, b)",
            |a, b| b + 8.0 * if a > 0.0 { a } else { b },
        ),
        (
            "struct S { v: vec3f, list: array<vec2f, 2> }\nfn f(a: f32, b: f32) -> f32 { var s: S; s.v.y = a; \
          for (var i = 0; i < 2; i++) { s.list[i] = vec2f(b, f32(i)); } return s.v.y + s.list[1].x + s.list[1].y; }",
            "f(a, b)",
            |a, b| a + b + 1.0,
        ),
        (
            "var<private> count: f32 = 1.0;\nfn more(a: f32) -> bool { count += a; return a > 0.0; }\n\
          fn f(a: f32, b: f32) -> f32 { if (b > 1.0 && more(a)) { count += 4.0; } return count; }",
            "f(a, b)",
            |a, b| {
                if b > 1.0 { 1.0 + a + if a > 0.0 { 4.0 } else { 0.0 } } else { 1.0 }
            },
        ),
        (
            "fn f(a: f32, b: f32) -> f32 { var x = 0.0; for (var i = 0u; i < 3u; i++) { for (var j = i; j < 3u; j++) { \
          if (a < f32(j) - 1.0) { break; } x += b; } if (x > 4.0) { return -1.0; } } return x; }",
            "f(a, b)",
            |a, b| {
                let mut x = 0.0;
                for i in 0..3 {
                    for j in i..3 {
                        if a < f64::from(j) - 1.0 {
                            break;
                        }
                        x += b;
                    }
                    if x > 4.0 {
                        return -1.0;
                    }
                }
                x
            },
        ),
    ];
    for (functions, expression, expected) in rows {
        holds(&shader(functions, expression), functions, 8.0, expected);
    }
    let kill = "fn f(a: f32) -> f32 { if (a < 0.0) { discard; } return 5.0; }";
    // A target starts with zeros.
    holds(&shader(kill, "f(a)"), "discard", 0.0, |a, _| if a < 0.0 { 0.0 } else { 5.0 });
}
