//! The median thickness of models whose thickness is known.

use approx::assert_relative_eq;
use crossbar::geom::Mesh;
use crossbar::subsurface::median_thickness;

use super::on_card::cube;

/// A box with edges parallel to the axes.
fn boxed(size: [f32; 3]) -> Mesh {
    let unit = cube(1.0);
    let scaled = unit.positions().iter().map(|p| [0, 1, 2].map(|axis| p[axis] * size[axis] + 3.0));
    Mesh::new(scaled.collect(), unit.triangles().to_vec()).expect("a box")
}

#[test]
fn cubes_and_slabs_are_as_thick_as_they_are() {
    let thickness = |size| median_thickness(&boxed(size)).expect("closed");
    assert_relative_eq!(thickness([10.0; 3]), 10.0, max_relative = 1e-5);
    // Most of the surface of a slab is its two sides, whichever way it stands.
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
    let square = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let square = Mesh::new(square, vec![[0, 1, 2], [0, 2, 3]]).expect("a square");
    assert_eq!(median_thickness(&square), None);
}
