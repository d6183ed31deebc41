use approx::abs_diff_eq;
use crossbar_ground::sphere::DirectionRule;
use glam::DVec3;
use std::f64::consts::PI;

/// Light inside a bowl, whose horizon has the same height all around; a rule of rings resolves that height only in
/// steps of a ring.
#[test]
fn horizons_of_any_height_are_told_to_a_fraction_of_a_ring() {
    let worst = |rule: &DirectionRule| {
        let off = |step: usize| {
            let height = 0.05 + 0.6 * step as f64 / 200.0;
            let light = rule.integral(|v| if v.z > height { v.z } else { 0.0 });
            (light / (PI * (1.0 - height * height)) - 1.0).abs()
        };
        (0..=200).map(off).fold(0.0, f64::max)
    };
    let [rings, spread] = [DirectionRule::hemisphere(44), DirectionRule::spread(44, 18)].map(|rule| worst(&rule));
    assert!(rings > 0.03 && spread < 0.004, "{rings} and {spread}");
}

#[test]
fn spread_directions_integrate_monomials_up_to_their_degree() {
    for (size, degree) in [(20, 8), (21, 8), (44, 18), (45, 18), (60, 18)] {
        let (spread, exact) = (DirectionRule::spread(size, degree), DirectionRule::hemisphere(degree));
        assert_eq!((spread.degree(), spread.len()), (degree, (size / 2 + 1) * 2 * (size / 2 + 1)));
        assert!(spread.weights().iter().all(|&weight| weight > 0.0));
        let power = |x: f64, k: usize| (0..k).fold(1.0, |product, _| product * x);
        for i in 0..=degree {
            for j in 0..=degree - i {
                for k in [0, 1, degree - i - j] {
                    let value = |v: DVec3| power(v.x, i) * power(v.y, j) * power(v.z, k.min(degree - i - j));
                    let (found, expected) = (spread.integral(value), exact.integral(value));
                    assert!(abs_diff_eq!(found, expected, epsilon = 2e-14), "{size} {degree}: {i} {j} {k}");
                }
            }
        }
    }
    assert_eq!(DirectionRule::spread(38, 18), DirectionRule::hemisphere(38), "20 rings are too few");
}

#[test]
fn monomials_are_integrated_up_to_the_degree_and_not_beyond() {
    // Over the sphere, the integral of z^k is 4 pi / (k + 1) for even k; over the hemisphere 2 pi / (k + 1).
    for degree in 0..=12 {
        let [sphere, hemisphere] = [DirectionRule::sphere(degree), DirectionRule::hemisphere(degree)];
        for k in 0..=degree {
            let power = |x: f64| (0..k).fold(1.0, |product, _| product * x);
            let whole = if k % 2 == 0 { 4.0 * PI / (k + 1) as f64 } else { 0.0 };
            for axis in 0..3 {
                assert!(abs_diff_eq!(sphere.integral(|v| power(v[axis])), whole, epsilon = 2e-14), "{degree} {k}");
                let half = if axis == 2 { 2.0 * PI / (k + 1) as f64 } else { whole / 2.0 };
                assert!(abs_diff_eq!(hemisphere.integral(|v| power(v[axis])), half, epsilon = 2e-14), "{k}");
            }
        }
        let next = degree + 2 + degree % 2;
        let power = |x: f64| (0..next).fold(1.0, |product, _| product * x);
        assert!(!abs_diff_eq!(sphere.integral(|v| power(v.z)), 4.0 * PI / (next + 1) as f64, epsilon = 1e-9));
    }
}
