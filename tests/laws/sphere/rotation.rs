//! Rotating the coefficients rotates the function.

use crossbar::sphere::{HarmonicRotation, MAX_ORDER, evaluate, function_count};
use glam::{DMat3, DVec3};
use proptest::prelude::*;

use super::{coefficients, direction, distance};

/// The rotation of a unit quaternion with scalar part w.
fn matrix([w, x, y, z]: [f64; 4]) -> DMat3 {
    let v = DVec3::new(x, y, z);
    let column = |axis: DVec3| axis + 2.0 * w * v.cross(axis) + 2.0 * v.cross(v.cross(axis));
    DMat3::from_cols(column(DVec3::X), column(DVec3::Y), column(DVec3::Z))
}

fn rotation() -> impl Strategy<Value = DMat3> {
    let parts = [-1.0..1.0, -1.0..1.0, -1.0..1.0, -1.0..1.0f64];
    let any = parts.prop_filter_map("far from 0", |q| {
        let length = q.iter().map(|part| part * part).sum::<f64>().sqrt();
        (length > 0.1).then(|| matrix(q.map(|part| part / length)))
    });
    prop_oneof![8 => any, 1 => Just(DMat3::IDENTITY)]
}

fn of(order: usize, matrix: &DMat3) -> HarmonicRotation {
    HarmonicRotation::new(order, matrix).expect("a rotation")
}

/// The matrix product for one band: rotation b followed by rotation a.
fn product(a: &[f64], b: &[f64], size: usize) -> Vec<f64> {
    let element = |k: usize| (0..size).map(|j| a[k / size * size + j] * b[j * size + k % size]).sum();
    (0..size * size).map(element).collect()
}

fn identity(size: usize) -> Vec<f64> {
    (0..size * size).map(|k| if k % (size + 1) == 0 { 1.0 } else { 0.0 }).collect()
}

proptest! {
    #[test]
    fn a_rotated_function_has_its_values_elsewhere(r in rotation(), c in coefficients(MAX_ORDER), v in direction()) {
        for order in 1..=MAX_ORDER {
            let c = &c[..function_count(order)];
            let mut turned = vec![0.0; c.len()];
            of(order, &r).apply(c, &mut turned);
            let off = (evaluate(&turned, r * v) - evaluate(c, v)).abs();
            prop_assert!(off < 2e-13, "order {}: {:e}", order, off);
        }
    }

    #[test]
    fn bands_are_orthogonal(r in rotation()) {
        let [there, back] = [of(MAX_ORDER, &r), of(MAX_ORDER, &r.transpose())];
        for l in 0..MAX_ORDER {
            let size = 2 * l + 1;
            prop_assert!(distance(&product(there.band(l), back.band(l), size), &identity(size)) < 2e-14);
        }
    }

    #[test]
    fn reflections_and_other_matrices_are_refused(r in rotation(), scale in 1.001..10.0f64) {
        let mirror = r * DMat3::from_diagonal(DVec3::new(1.0, -1.0, 1.0));
        let reflected = HarmonicRotation::new(4, &mirror).unwrap_err().to_string();
        prop_assert!(reflected.starts_with("expected a rotation matrix, found a reflection"), "{}", reflected);
        for scale in [scale, f64::NAN] {
            let refused = HarmonicRotation::new(4, &(r * scale)).unwrap_err().to_string();
            prop_assert!(refused.contains("with orthonormal columns"), "{}", refused);
        }
    }
}
