//! Exact fractions behind the appendix of "Clustered Principal Components" (2003), whose printed digits are rows of
//! `crossbar reproduce`.

use crossbar::linalg::SymmetricEigen;
use crossbar::sphere::{Hemisphere, HemisphereProjection as Projection, ProjectionErrors, function_index};

fn near(found: f64, expected: f64, relative: f64) -> bool {
    (found - expected).abs() <= relative * expected.abs()
}

fn error(projection: Projection, order: usize) -> ProjectionErrors {
    projection.error(5, order).expect("eigenvalues")
}

#[test]
fn the_second_singular_value_is_double() {
    let hemisphere = Hemisphere::new(5);
    let values = &hemisphere.spectrum().values;
    assert!(near(values[24], 6.592114101e-6, 1e-9) && near(values[0], 0.999993407886, 1e-12));
    for second in [values[23], values[22]] {
        assert!(near(second, 3.096197377e-4, 1e-9), "double: {second:e}");
    }
    assert!(values[21] > 1e-3, "the next is no third: {:e}", values[21]);
}

/// Computes the printed singular values from A with another algorithm.
#[test]
fn the_spectrum_of_the_gram_matrix() {
    for order in 1..=10 {
        let hemisphere = Hemisphere::new(order);
        let eigen = SymmetricEigen::new(hemisphere.gram()).expect("eigenvalues");
        for (found, expected) in hemisphere.spectrum().values.iter().zip(&eigen.values) {
            assert!((found - expected).abs() < 1e-14, "order {order}: {found:e} {expected:e}");
        }
    }
}

#[test]
fn linear_in_z_is_the_cheapest_function_to_drop() {
    let hemisphere = Hemisphere::new(5);
    let costs = hemisphere.drop_costs();
    let linear = function_index(1, 0);
    assert!(costs.iter().enumerate().all(|(index, &cost)| index == linear || cost > costs[linear]));
    assert!(near(costs[linear], 1.0 / 67_712.0, 1e-13), "{:e}", costs[linear]);
    // Equals the quotient of the determinants with and without the function, computed from two other spectra.
    let product = |hemisphere: &Hemisphere| hemisphere.spectrum().values.iter().product::<f64>();
    let without = Hemisphere::without(5, &[linear]).expect("24 functions");
    assert!(near(product(&hemisphere) / product(&without), costs[linear], 1e-10));
}

#[test]
fn projections_have_exact_errors() {
    for (projection, order, exact_worst, exact_average) in [
        (Projection::ZeroHemisphere, 5, 1.0 / 8.0, 2635.0 / 65_536.0),
        (Projection::OddReflection, 8, 0.145268853471, 1_163_337.0 / 26_214_400.0),
        (Projection::EvenReflection, 7, 0.0220054624081, 2931.0 / 819_200.0),
        (Projection::EvenReflection, 5, 0.1929539503, 4983.0 / 163_840.0),
    ] {
        let ProjectionErrors { worst, average } = error(projection, order);
        assert!(near(worst, exact_worst, 1e-10) && near(average, exact_average, 1e-12), "{worst} {average}");
    }
}

/// The paper's ranking of the projections. The printed ranking, with "odd" and "even" exchanged, is wrong.
#[test]
fn even_reflection_is_best_and_odd_reflection_worst() {
    let [zero, odd] = [error(Projection::ZeroHemisphere, 5), error(Projection::OddReflection, 8)];
    assert!(odd.worst > zero.worst && odd.average > zero.average);
    for order in [5, 7] {
        assert!(error(Projection::EvenReflection, order).average < zero.average);
    }
    let literal = error(Projection::EvenReflection, 8);
    assert_eq!([literal.worst, literal.average].map(|error| format!("{error:.5}")), ["0.00759", "0.00158"]);
}
