use std::collections::BTreeSet;

use crossbar_base::geom::teapot::{teapot, tessellate};
use crossbar_base::geom::vector::place_bits;

#[test]
fn corners_are_control_points() {
    let mesh = teapot(1).expect("a teapot");
    assert_eq!(mesh.positions()[0], [1.4, 0.0, 2.4]);
    assert_eq!(mesh.positions()[1], [0.0, -1.4, 2.4]);
    assert!(mesh.positions().contains(&[2.8, 0.0, 2.4]), "the spout's tip");
}

/// A wrong digit of any control point would break a symmetry, because all control points affect inner points of their
/// patch.
#[test]
fn every_part_is_its_own_mirror_image_and_turned_parts_have_four_like_quarters() {
    let teapot = tessellate(5).expect("a teapot");
    let places = |first: u8, map: fn([f32; 3]) -> [f32; 3]| -> BTreeSet<[u32; 3]> {
        let triangles = teapot.mesh.iter_corners().zip(&teapot.patch_of);
        let of_part = triangles.filter(|&(_, &patch)| (first..first + 4).contains(&patch));
        of_part.flat_map(|(corners, _)| corners).map(|at| place_bits(map(at))).collect()
    };
    for first in (0..32).step_by(4) {
        assert_eq!(places(first, |at| at), places(first, |[x, y, z]| [x, -y, z]), "patches from {first}");
        let is_turned = ![12, 16].contains(&first);
        assert_eq!(places(first, |at| at) == places(first, |[x, y, z]| [-y, x, z]), is_turned, "patches from {first}");
    }
}
