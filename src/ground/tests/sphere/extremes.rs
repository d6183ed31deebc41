use crossbar_ground::sphere::{function_count, function_index, harmonics, least};
use glam::DVec3;
use std::f64::consts::PI;

fn largest(coefficients: &[f64]) -> (f64, DVec3) {
    let (value, at) = least(&coefficients.iter().map(|c| -c).collect::<Vec<f64>>());
    (-value, at)
}

#[test]
fn a_linear_function_is_largest_along_its_vector() {
    let function = [2.0, 2.0, 3.0, 6.0];
    let ((least, least_at), (largest, largest_at)) = (least(&function), largest(&function));
    let direction = DVec3::new(6.0, 2.0, 3.0) / 7.0;
    assert!(largest_at.distance(direction) < 1e-7 && least_at.distance(-direction) < 1e-7);
    let [constant, linear] = [2.0 / (4.0 * PI).sqrt(), 7.0 * (3.0 / (4.0 * PI)).sqrt()];
    assert!((largest - constant - linear).abs() < 1e-14 && (least - constant + linear).abs() < 1e-14);
}

#[test]
fn a_delta_is_largest_at_its_place() {
    for order in 1..=10 {
        let mut delta = vec![0.0; function_count(order)];
        let place = DVec3::new(1.0, -2.0, 2.0) / 3.0;
        harmonics(order, place, &mut delta);
        let (found, at) = largest(&delta);
        // The addition theorem: the square sum of harmonics is n^2 / (4 pi).
        let expected = (order * order) as f64 / (4.0 * PI);
        assert!((found - expected).abs() < 1e-13 * expected, "{order}: {found}");
        assert!(order == 1 || at.distance(place) < 1e-6, "{order}: {at}");
    }
    // P_2 = (3 z^2 - 1) / 2 is least on the equator.
    let mut zonal = [0.0; 9];
    zonal[function_index(2, 0)] = (4.0 * PI / 5.0).sqrt();
    assert!((least(&zonal).0 + 0.5).abs() < 1e-15 && (largest(&zonal).0 - 1.0).abs() < 1e-15);
}
