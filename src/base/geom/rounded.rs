//! Uncertainty of corners whose coordinates were rounded to f32.

use glam::DVec3;

use super::vector::{area_vector, wide};

/// Largest distance by which rounding moved a corner: each coordinate's error is at most 2^-24 of the largest
/// coordinate.
fn reach(corners: &[DVec3]) -> f64 {
    let largest = corners.iter().map(|corner| corner.abs().max_element()).fold(0.0, f64::max);
    3_f64.sqrt() * f64::from(f32::EPSILON) / 2.0 * largest
}

/// Returns `true` if a triangle has an area for every possible rounding of its corners. Rounding moves corners of a
/// degenerate triangle by at most `reach`, so its least height is then at most twice that.
pub fn has_certain_area(triangle: &[[f32; 3]; 3]) -> bool {
    let corners @ [a, b, c] = triangle.map(wide);
    let longest = (b - a).length().max((c - b).length()).max((a - c).length());
    area_vector(corners).length() > 2.0 * reach(&corners) * longest
}

/// Returns `true` if the triangles `a`, `b`, `c` and `a`, `b`, `d` overlap: both are on the same side of their common
/// edge, and may have been in one plane before rounding. A moved corner changes six times the tetrahedron's volume by
/// at most its displacement times twice the area of the opposite face.
pub fn may_overlap([a, b]: [DVec3; 2], [c, d]: [DVec3; 2]) -> bool {
    let (one, other) = ((b - a).cross(c - a), (b - a).cross(d - a));
    let faces = [one, other, (c - a).cross(d - a), (c - b).cross(d - b)].map(DVec3::length);
    one.dot(other) > 0.0 && one.dot(d - a).abs() <= reach(&[a, b, c, d]) * faces.iter().sum::<f64>()
}
