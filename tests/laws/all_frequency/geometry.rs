//! "At any vertex, at least 4 out of 24 segments are below the normal's hemisphere; on average, about 8 out of 24 are"
//! (section 5): the exact geometry, for every normal.

use std::f64::consts::PI;

use crossbar::sphere::CubeMap;
use crossbar::transfer::linear_basis::{BasisWidth, LinearBasis};
use crossbar::transfer::visibility::segments_below_horizon;
use glam::DVec3;

use super::close;

/// The smallest, mean and largest number of segments below the horizon, over the directions of a fine cube map.
fn below(width: BasisWidth, side: usize) -> (u32, f64, u32) {
    let (hats, map) = (LinearBasis::new(width), CubeMap::new(side));
    let (mut least, mut most, mut sum, mut whole) = (24, 0, 0.0, 0.0);
    for at in 0..map.len() {
        let (face, row, column) = (at / (side * side), at / side % side, at % side);
        let count = segments_below_horizon(map.direction(face, column, row), &hats).count_ones();
        let weight = map.solid_angle(column, row);
        (least, most) = (least.min(count), most.max(count));
        sum += weight * f64::from(count);
        whole += weight;
    }
    (least, sum / whole, most)
}

/// A segment lies below the horizon of a normal if its four corners do. Such normals form a convex polygon, whose area
/// is 2 pi minus the segment's perimeter. On average that is 6.649 of 24 segments, not 8: omega is 0.723, not 2/3. The
/// smallest number is 6.
#[test]
fn on_average_6_65_segments_are_below_the_horizon() {
    let arc = |a: DVec3, b: DVec3| crossbar::elementary::acos(a.normalize().dot(b.normalize()));
    let [middle, edge, corner] = [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 1.0, 1.0]].map(DVec3::from);
    let perimeter = 2.0 * (arc(middle, edge) + arc(edge, corner));
    let closed = 24.0 * (2.0 * PI - perimeter) / (4.0 * PI);
    close(closed, 6.649, 5e-4, "the closed form");
    let (least, mean, most) = below(BasisWidth::OneTexel, 64);
    // Fine directions lie at least half a fine texel inside a segment's border, so slightly more segments are below.
    assert!(mean > closed && mean < closed * 1.03, "{mean} {closed}");
    assert_eq!((least, most), (6, 8));
}

/// The two-texel linear basis reaches over the borders, so fewer segments are empty: at least 3, on average 6.44.
#[test]
fn with_hats_that_reach_over_fewer_are() {
    let (least, mean, most) = below(BasisWidth::TwoTexels, 64);
    assert_eq!((least, most), (3, 7));
    close(mean, 6.44, 0.02, "the mean");
}
