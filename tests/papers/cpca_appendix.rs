//! Checks every printed digit of the appendix of "Clustered Principal Components" (2003), and the exact fractions.

use crossbar::linalg::SymmetricEigen;
use crossbar::sphere::{
    Hemisphere, HemisphereProjection as Projection, ProjectionErrors, function_count, function_index,
};

/// Returns `true` if a number, written in scientific notation with as many digits as were printed, equals the printed
/// number.
fn prints_as(value: f64, printed: &str) -> bool {
    let digits = printed.split_once('e').expect("scientific notation").0.len().saturating_sub(2);
    format!("{value:.digits$e}") == printed
}

fn near(found: f64, expected: f64, relative: f64) -> bool {
    (found - expected).abs() <= relative * expected.abs()
}

fn error(projection: Projection, order: usize) -> ProjectionErrors {
    projection.error(5, order).expect("eigenvalues")
}

#[test]
fn the_spectrum_of_order_5() {
    let hemisphere = Hemisphere::new(5);
    let values = &hemisphere.spectrum().values;
    assert!(prints_as(values[24], "6.59e-6") && near(values[24], 6.592114101e-6, 1e-9), "{:e}", values[24]);
    assert!(near(values[0], 0.999993407886, 1e-12) && format!("{:.0}", values[0]) == "1", "{}", values[0]);
    for second in [values[23], values[22]] {
        assert!(prints_as(second, "3.10e-4") && near(second, 3.096197377e-4, 1e-9), "double: {second:e}");
    }
    assert!(values[21] > 1e-3, "the next is no third: {:e}", values[21]);
    assert!(near(values[0] / values[24], 151_695.0, 1e-5), "the condition: {}", values[0] / values[24]);
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
    assert!(prints_as(costs[linear], "1.48e-5"), "{:e}", costs[linear]);
    assert!(near(costs[linear], 1.0 / 67_712.0, 1e-13), "{:e}", costs[linear]);
    let largest = hemisphere.inverse().rows().flatten().fold(0.0, |most: f64, value| most.max(value.abs()));
    assert!(near(largest, 67_712.0, 1e-13), "{largest}");
    // Equals the quotient of the determinants with and without the function, computed from two other spectra.
    let product = |hemisphere: &Hemisphere| hemisphere.spectrum().values.iter().product::<f64>();
    let without = Hemisphere::without(5, &[linear]).expect("24 functions");
    assert_eq!(without.functions().len(), 24);
    assert!(near(product(&hemisphere) / product(&without), costs[linear], 1e-10));
}

#[test]
fn zero_hemisphere_is_wrong_by_35_and_20_percent() {
    let ProjectionErrors { worst, average } = error(Projection::ZeroHemisphere, 5);
    assert_eq!((format!("{worst:.3}"), format!("{average:.4}")), ("0.125".to_owned(), "0.0402".to_owned()));
    assert!(near(worst, 1.0 / 8.0, 1e-13) && near(average, 2635.0 / 65_536.0, 1e-13), "{worst} {average}");
    assert_eq!([worst, average].map(|error| format!("{:.0}", 100.0 * error.sqrt())), ["35", "20"], "percent RMS");
    assert_eq!([worst, average].map(|error| format!("{:.2}", 100.0 * error.sqrt())), ["35.36", "20.05"]);
}

#[test]
fn reflections_have_the_printed_numbers_of_functions() {
    let count =
        |projection: Projection, order| (0..function_count(order)).filter(|&i| projection.uses(order, i)).count();
    assert_eq!([8, 7, 5].map(|order| count(Projection::EvenReflection, order)), [36, 28, 15]);
    assert_eq!((count(Projection::OddReflection, 8), function_count(8)), (28, 64));
}

#[test]
fn reflections_have_the_printed_errors() {
    let cases = [
        (Projection::OddReflection, 8, ["0.145", "0.044"], 0.145268853471, 1_163_337.0 / 26_214_400.0),
        (Projection::EvenReflection, 7, ["0.022", "0.0036"], 0.0220054624081, 2931.0 / 819_200.0),
        (Projection::EvenReflection, 5, ["0.193", "0.030"], 0.1929539503, 4983.0 / 163_840.0),
    ];
    for (projection, order, printed, exact_worst, exact_average) in cases {
        let ProjectionErrors { worst, average } = error(projection, order);
        let digits = printed.map(|printed| printed.len() - 2);
        let [worst_digits, average_digits] = digits;
        let found = [format!("{worst:.worst_digits$}"), format!("{average:.average_digits$}")];
        assert_eq!(found, printed, "{projection:?} {order}");
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
    let best = error(Projection::LeastSquares, 5);
    assert!(best.worst.abs() < 1e-24 && best.average.abs() < 1e-24, "{best:?}");
}
