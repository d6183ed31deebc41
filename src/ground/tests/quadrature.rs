use approx::abs_diff_eq;
use crossbar_base::elementary;
use crossbar_ground::quadrature::{EIGHT, FIVE, MAX_POINTS, SIXTEEN, THREE, gauss_legendre, graded_integral, integral};

#[test]
fn powers_are_integrated_exactly_up_to_their_degree() {
    for rule in [&THREE[..], &FIVE, &EIGHT, &SIXTEEN] {
        for power in 0..2 * rule.len() {
            let value = |x: f64| (0..power).fold(1.0, |product, _| product * x);
            let sum: f64 = rule.iter().map(|&(x, weight)| weight * value(x)).sum();
            let exact = 1.0 / (power + 1) as f64;
            assert!(abs_diff_eq!(sum, exact, epsilon = 4e-16), "{} points, degree {power}: {sum}", rule.len());
        }
    }
}

#[test]
fn rules_of_any_size_are_those_of_the_tables_and_exact() {
    for table in [&THREE[..], &FIVE, &EIGHT, &SIXTEEN] {
        for (found, expected) in gauss_legendre(table.len()).iter().zip(table) {
            assert!(abs_diff_eq!(found.0, expected.0, epsilon = 1e-15), "{found:?} {expected:?}");
            assert!(abs_diff_eq!(found.1, expected.1, epsilon = 1e-15), "{found:?} {expected:?}");
        }
    }
    assert_eq!(gauss_legendre(1), [(0.5, 1.0)]);
    for points in [2, 7, 33, 128, MAX_POINTS] {
        let rule = gauss_legendre(points);
        for power in [0, 1, 2, points, 2 * points - 1] {
            let sum: f64 = rule.iter().map(|&(x, weight)| weight * elementary::pow(x, power as f64)).sum();
            assert!(abs_diff_eq!(sum, 1.0 / (power + 1) as f64, epsilon = 2e-14), "{points}, {power}: {sum}");
        }
        assert!(rule.is_sorted_by(|a, b| a.0 < b.0), "{points} points in increasing order");
    }
}

#[test]
fn graded_intervals_follow_a_singularity() {
    let sum = graded_integral(4.0, 60, f64::sqrt);
    assert!(abs_diff_eq!(sum, 16.0 / 3.0, epsilon = 1e-14), "{sum}");
    assert!(abs_diff_eq!(integral(-1.0, 2.0, |x| x * x * x), 3.75, epsilon = 1e-15));
}
