//! Functions on the sphere: harmonics, their rotation, the hemisphere, maps and light.

mod environment;
mod harmonics;
mod hemisphere;
mod light;
mod maps;
mod rotation;

use crossbar::sphere::{function_count, harmonics as values};
use glam::DVec3;
use proptest::prelude::*;

/// Values of all functions of an order in a direction.
fn functions(order: usize, direction: DVec3) -> Vec<f64> {
    let mut y = vec![0.0; function_count(order)];
    values(order, direction, &mut y);
    y
}

/// The largest distance between corresponding elements of two lists.
fn distance(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter()
        .zip(b)
        .fold(0.0, |most: f64, (a, b)| if a.is_nan() || b.is_nan() { f64::NAN } else { most.max((a - b).abs()) })
}

/// Directions of length 1.
fn direction() -> impl Strategy<Value = DVec3> {
    let point = [-1.0..1.0, -1.0..1.0, -1.0..1.0f64].prop_map(DVec3::from);
    point.prop_filter("far from 0", |v| (0.01..1.0).contains(&v.length_squared())).prop_map(|v| v / v.length())
}

/// Random coefficients from -1 to 1, one per function of the order.
fn coefficients(order: usize) -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(-1.0..1.0f64, function_count(order))
}
