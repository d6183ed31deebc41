use crossbar_ground::sphere::CubeMap;
use glam::DVec3;
use std::f64::consts::PI;

#[test]
fn centers_fall_into_their_texels() {
    let map = CubeMap::new(5);
    for (face, column, row) in (0..150).map(|at| (at / 25, at % 5, at / 5 % 5)) {
        assert_eq!(map.texel_of(3.0 * map.direction(face, column, row)), [face, column, row]);
    }
    assert_eq!(map.texel_of(DVec3::new(1.0, 1.0, 0.0))[0], 0, "the lower of two faces");
    assert_eq!(map.texel_of(DVec3::new(1.0, -1.0, -1.0)), [0, 4, 4], "a corner");
}

#[test]
fn a_face_of_a_cube_covers_a_sixth_and_its_parts_add_up() {
    let whole = 2.0 / 3.0 * PI;
    assert!((CubeMap::new(1).solid_angle(0, 0) - whole).abs() < 1e-15);
    let map = CubeMap::new(16);
    let parts = (0..256).map(|at| map.solid_angle(at % 16, at / 16));
    assert!((parts.sum::<f64>() - whole).abs() < 1e-14);
    // A texel of side 2^-29 next to the middle of the face.
    let tiny = CubeMap::new(1 << 30).solid_angle(1 << 29, 1 << 29);
    let square = f64::from_bits((1023 - 58) << 52);
    assert!((tiny / square - 1.0).abs() < 1e-15, "no digit is lost: {tiny:e}");
}
