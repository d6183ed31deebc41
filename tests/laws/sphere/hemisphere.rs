//! The Gram matrix over the hemisphere, its inverse, and projections.

use crossbar::linalg::Matrix;
use crossbar::sphere::{
    DirectionRule, Hemisphere, HemisphereProjection as Projection, MAX_ORDER, evaluate, function_band, function_count,
    function_index,
};
use proptest::prelude::*;

use super::{coefficients, distance, functions};

fn from_identity(product: &Matrix) -> f64 {
    let rows = product.rows().enumerate();
    let off = |(i, row): (usize, &[f64])| {
        row.iter().enumerate().map(|(j, value)| (value - if i == j { 1.0 } else { 0.0 }).abs()).fold(0.0, f64::max)
    };
    rows.map(off).fold(0.0, f64::max)
}

#[test]
fn the_gram_matrix_is_that_of_a_rule_over_the_hemisphere() {
    for order in 1..=MAX_ORDER {
        let hemisphere = Hemisphere::new(order);
        let rule = DirectionRule::hemisphere(2 * order - 2);
        for index in 0..function_count(order) {
            let found = rule.project(order, |v| functions(order, v)[index]);
            assert!(distance(&found, hemisphere.gram().row(index)) < 5e-15, "order {order}, row {index}");
        }
    }
}

/// The rounding of the product alone is the condition number times 2^-53; the error of the inverse corresponds to the
/// root of the condition number.
#[test]
fn the_inverse_is_one() {
    for order in 1..=MAX_ORDER {
        let hemisphere = Hemisphere::new(order);
        let values = &hemisphere.spectrum().values;
        let condition = values[0] / values[values.len() - 1];
        let off = from_identity(&hemisphere.gram().product(hemisphere.inverse()).expect("small"));
        assert!(off < 4.0 * f64::EPSILON * condition, "order {order}: {off:e}, condition {condition:e}");
    }
}

/// In exact fractions the diagonal of the inverse consists of integers. Here: l = 0, 1 and 2 with m = 0.
#[test]
fn the_diagonal_of_the_inverse_is_whole() {
    for (order, expected) in [
        (3, [98.0, 128.0, 32.0]),
        (5, [38_242.0, 67_712.0, 37_152.0]),
        (8, [571_387_904.0, 1_221_914_624.0, 1_020_889_088.0]),
        (9, [15_271_248_770.0, 33_859_930_112.0, 30_534_075_008.0]),
        (10, [418_796_912_008.0, 956_070_153_608.0, 916_344_171_008.0]),
    ] {
        let diagonal = Hemisphere::new(order).inverse().diagonal();
        let root_of_condition = f64::sqrt(expected[1]);
        for (l, expected) in expected.into_iter().enumerate() {
            let off: f64 = diagonal[function_index(l, 0)] / expected - 1.0;
            assert!(off.abs() < 16.0 * f64::EPSILON * root_of_condition, "order {order}, l = {l}: {off:e}");
        }
    }
}

/// A is 1/2 I plus a matrix that couples only functions of odd l + m with functions of even l + m.
#[test]
fn the_spectrum_is_symmetric_about_one_half() {
    for order in 1..=MAX_ORDER {
        let values = Hemisphere::new(order).spectrum().values.clone();
        let off = values.iter().zip(values.iter().rev()).map(|(a, b)| (a + b - 1.0).abs()).fold(0.0, f64::max);
        assert!(values.is_sorted_by(|a, b| a >= b) && (order == 1 || off < 1e-14), "order {order}: {off:e}");
    }
}

#[test]
fn any_set_of_functions_has_its_own_inverse() {
    let linear = function_index(1, 0);
    let (whole, part) = (Hemisphere::new(5), Hemisphere::without(5, &[linear, 0, 24]).expect("22 functions"));
    assert!(part.functions().len() == 22 && !part.functions().contains(&linear));
    for (row, &i) in part.functions().iter().enumerate() {
        for (column, &k) in part.functions().iter().enumerate() {
            assert_eq!(part.gram().row(row)[column], whole.gram().row(i)[k]);
        }
    }
    assert!(from_identity(&part.gram().product(part.inverse()).expect("small")) < 1e-11);
    let least = |hemisphere: &Hemisphere| *hemisphere.spectrum().values.last().expect("a value");
    let section_6_1 = Hemisphere::without(5, &[linear]).expect("24 functions");
    assert!(least(&section_6_1) > 10.0 * least(&whole), "{:e}: without it A is far from singular", least(&section_6_1));
}

#[test]
fn least_squares_is_the_best_of_all() {
    for signal in [3, 5] {
        for order in [2, 4, 5, 8] {
            let best = Projection::LeastSquares.error(signal, order).expect("eigenvalues");
            for other in [
                Projection::ZeroHemisphere,
                Projection::OddReflection,
                Projection::EvenReflection,
                Projection::ScaledOddReflection,
            ] {
                let error = other.error(signal, order).expect("eigenvalues");
                assert!(best.worst <= error.worst + 1e-14 && best.average <= error.average + 1e-14, "{other:?}");
                assert!(error.average <= error.worst && error.average >= 0.0, "{other:?} {error:?}");
            }
            // Rounding of the integrals, divided by the root of the smallest eigenvalue.
            let least = *Hemisphere::new(order).spectrum().values.last().expect("a value");
            let rounding = 32.0 * f64::EPSILON * f64::EPSILON / least;
            assert!(order < signal || best.worst < rounding, "{signal} {order}: {best:?}");
        }
    }
}

proptest! {
    /// Dividing by z inverts it exactly where z f is odd in z and within the order: f even in z, one order lower.
    #[test]
    fn scaled_odd_reflection_reproduces_even_functions_of_lower_order(mut c in coefficients(4)) {
        for (index, c) in c.iter_mut().enumerate() {
            let (l, m) = function_band(index);
            if (l + m.unsigned_abs()) % 2 == 1 {
                *c = 0.0;
            }
        }
        let found = Projection::ScaledOddReflection.project(5, &DirectionRule::hemisphere(8), |v| evaluate(&c, v));
        prop_assert!(distance(&found[..16], &c) < 1e-13);
        prop_assert!(distance(&found[16..], &[0.0; 9]) < 1e-13);
    }
}
