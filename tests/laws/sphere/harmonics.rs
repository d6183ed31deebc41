//! Tests spherical harmonics against their definition, orthonormality and published constants.

use std::f64::consts::PI;

use approx::assert_abs_diff_eq;
use crossbar::sphere::{DirectionRule, MAX_ORDER, function_band, function_count, least};
use glam::DVec3;
use proptest::prelude::*;

use super::{direction, distance, functions};

#[test]
fn functions_are_orthonormal_at_every_order() {
    for order in 1..=MAX_ORDER {
        let rule = DirectionRule::sphere(2 * order - 2);
        for index in 0..function_count(order) {
            let mut unit = vec![0.0; function_count(order)];
            unit[index] = 1.0;
            let found = rule.project(order, |v| functions(order, v)[index]);
            assert!(distance(&found, &unit) < 5e-15, "order {order}, function {index}: {}", distance(&found, &unit));
        }
    }
}

/// y_lm by Rodrigues' formula: P_l is the l-th derivative of (z^2 - 1)^l / (2^l l!); y_lm is the m-th derivative of P_l
/// times the real or imaginary part of (x + iy)^m and a normalizing factor. All coefficients are integers that f64
/// represents exactly.
fn by_definition(index: usize, v: DVec3) -> f64 {
    let (l, m) = function_band(index);
    let sine = m < 0;
    let m = m.unsigned_abs();
    let factorial = |n: usize| (1..=n).fold(1.0, |product, k| product * k as f64);
    let power = |x: f64, n: usize| (0..n).fold(1.0, |product, _| product * x);
    let mut sum = 0.0;
    for k in 0..=l {
        // (-1)^k binomial(l, k) z^(2l - 2k), differentiated l + m times.
        let degree = 2 * (l - k);
        if degree >= l + m {
            let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
            let binomial = factorial(l) / (factorial(k) * factorial(l - k));
            let falling = factorial(degree) / factorial(degree - l - m);
            sum += sign * binomial * falling * power(v.z, degree - l - m);
        }
    }
    let (mut re, mut im) = (1.0, 0.0);
    for _ in 0..m {
        (re, im) = (v.x * re - v.y * im, v.x * im + v.y * re);
    }
    let sides = if m == 0 { 1.0 } else { 2.0 };
    let norm = sides * (2 * l + 1) as f64 / (4.0 * PI) * factorial(l - m) / factorial(l + m);
    norm.sqrt() * sum / (power(2.0, l) * factorial(l)) * if sine { im } else { re }
}

proptest! {
    #[test]
    fn recurrences_give_the_definition(v in direction()) {
        let found = functions(MAX_ORDER, v);
        let expected: Vec<f64> = (0..found.len()).map(|index| by_definition(index, v)).collect();
        prop_assert!(distance(&found, &expected) < 1e-12, "{}", distance(&found, &expected));
    }

    #[test]
    fn lower_orders_are_the_beginning_of_higher_ones(v in direction(), order in 1..MAX_ORDER) {
        prop_assert_eq!(&functions(order, v)[..], &functions(MAX_ORDER, v)[..function_count(order)]);
    }
}

/// Constants of Sloan's "Efficient Spherical Harmonic Evaluation". Its y_lm are ours times (-1)^m, as in D3DX.
#[test]
fn functions_have_the_published_constants() {
    let v = DVec3::new(0.48, -0.6, 0.64);
    let found = functions(3, v);
    let expected = [
        0.2820947917738781,
        0.4886025119029199 * v.y,
        0.4886025119029199 * v.z,
        0.4886025119029199 * v.x,
        2.0 * 0.5462742152960395 * v.x * v.y,
        1.092548430592079 * v.z * v.y,
        0.9461746957575601 * v.z * v.z - 0.3153915652525201,
        1.092548430592079 * v.z * v.x,
        0.5462742152960395 * (v.x * v.x - v.y * v.y),
    ];
    assert!(distance(&found, &expected) < 1e-15, "{found:?}");
}

/// A signed 16-bit map of the functions needs values in [-1, 1]: up to order 6 no value exceeds 1.
#[test]
fn functions_up_to_order_6_stay_below_1() {
    for (order, largest) in [(5, (9.0 / (4.0 * PI)).sqrt()), (6, 0.935_602_579), (7, 1.017_107_236)] {
        let of = |index: usize| {
            let mut unit = vec![0.0; function_count(order)];
            unit[index] = 1.0;
            let lowest = least(&unit).0;
            unit[index] = -1.0;
            lowest.abs().max(least(&unit).0.abs())
        };
        let found = (0..function_count(order)).map(of).fold(0.0, f64::max);
        assert_abs_diff_eq!(found, largest, epsilon = 1e-9);
    }
}
