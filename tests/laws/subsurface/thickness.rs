//! The median thickness of models of known thickness.

use approx::assert_relative_eq;
use crossbar::subsurface::median_thickness;

use crate::support::{cuboid, plate};

#[test]
fn cubes_and_slabs_are_as_thick_as_they_are() {
    let thickness =
        |size: [f32; 3]| median_thickness(&cuboid([3.0; 3], size.map(|length| length + 3.0))).expect("closed");
    assert_relative_eq!(thickness([10.0; 3]), 10.0, max_relative = 1e-5);
    // Most of a slab's surface belongs to its two large sides, in any orientation.
    for turn in 0..3 {
        let mut size = [10.0, 10.0, 1.0];
        size.rotate_right(turn);
        assert_relative_eq!(thickness(size), 1.0, max_relative = 1e-5);
    }
    // A rod of 10 x 2 x 2.
    assert_relative_eq!(thickness([10.0, 2.0, 2.0]), 2.0, max_relative = 1e-5);
}

#[test]
fn open_models_have_no_thickness() {
    assert_eq!(median_thickness(&plate(1.0, 1.0)), None);
}
