//! Clipping of convex polygons.

use glam::DVec3;

/// The part of a convex polygon where a linear function is not negative.
pub(super) fn clip(outline: &[DVec3], function: impl Fn(DVec3) -> f64) -> Vec<DVec3> {
    let mut part = Vec::with_capacity(outline.len() + 1);
    for (&a, &b) in outline.iter().zip(outline.iter().cycle().skip(1)) {
        let [at_a, at_b] = [a, b].map(&function);
        if at_a >= 0.0 {
            part.push(a);
        }
        if (at_a > 0.0 && at_b < 0.0) || (at_a < 0.0 && at_b > 0.0) {
            part.push(a + at_a / (at_a - at_b) * (b - a));
        }
    }
    part
}
