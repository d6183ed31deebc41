//! Lights by code.

use crossbar::elementary;
use crossbar::sphere::{DirectionRule, HarmonicLight, MAX_ORDER};
use glam::DVec3;
use proptest::prelude::*;

use super::{direction, distance, functions};

/// A disk's coefficients by quadrature in the disk's own frame.
fn disk_by_quadrature(order: usize, center: DVec3, radius: f64) -> Vec<f64> {
    let u = center.any_orthonormal_vector();
    let w = center.cross(u);
    let (least_z, rule) = (elementary::sin_cos(radius).1, DirectionRule::hemisphere(2 * order));
    // The rule's z from 0 to 1 becomes one from the disk's rim to its center.
    rule.directions().iter().zip(rule.weights()).fold(vec![0.0; order * order], |mut sums, (v, weight)| {
        let flat = (v.x * v.x + v.y * v.y).sqrt();
        let z = least_z + (1.0 - least_z) * v.z;
        let rise = ((1.0 - z) * (1.0 + z)).sqrt();
        let at = rise * (v.x / flat * u + v.y / flat * w) + z * center;
        let weight = weight * (1.0 - least_z);
        sums.iter_mut().zip(functions(order, at)).for_each(|(sum, y)| *sum += weight * y);
        sums
    })
}

proptest! {
    #[test]
    fn disks_are_the_integrals_of_harmonics(center in direction(), radius in 0.01..3.1f64) {
        let light = HarmonicLight::disk(MAX_ORDER, center, radius, [1.0, 2.0, 0.0]).expect("a light");
        let expected = disk_by_quadrature(MAX_ORDER, center, radius);
        prop_assert!(distance(&light.channels()[0], &expected) < 1e-12);
        let doubled: Vec<f64> = light.channels()[0].iter().map(|c| 2.0 * c).collect();
        prop_assert!(light.channels()[1] == doubled && light.channels()[2] == [0.0; 100]);
    }
}
