//! Compares texels of cube maps with the emulated card's lookup, and solid angles with closed forms.

use std::f64::consts::PI;

use approx::assert_abs_diff_eq;
use crossbar::elementary::atan2;
use crossbar::sphere::{CUBE_FACES, CubeMap, ParabolicMap};
use refsim::texture::{CubeFace, cube_coordinates};

#[test]
fn the_emulated_card_finds_each_texel_where_we_put_it() {
    use CubeFace::{NegativeX, NegativeY, NegativeZ, PositiveX, PositiveY, PositiveZ};
    let map = CubeMap::new(8);
    for (face, expected) in [PositiveX, NegativeX, PositiveY, NegativeY, PositiveZ, NegativeZ].into_iter().enumerate() {
        for texel in 0..64 {
            let (column, row) = (texel % 8, texel / 8);
            let direction = map.direction(face, column, row);
            assert!((direction.length() - 1.0).abs() < 4e-16);
            let (found, u, v) = cube_coordinates(direction.to_array().map(|along| (along as f32).to_bits()));
            let place = [u, v].map(|at| (8.0 * f32::from_bits(at)).floor() as usize);
            assert_eq!((found, place), (expected, [column, row]), "face {face}: {direction}");
        }
        let axes = CUBE_FACES[face];
        assert_eq!(axes.center.dot(axes.right), 0.0);
        assert!(axes.right.cross(axes.down).dot(axes.center).abs() == 1.0, "{axes:?}");
    }
}

#[test]
fn texels_of_a_cube_cover_the_sphere() {
    for side in [1, 2, 7, 32] {
        let map = CubeMap::new(side);
        let row = |row: usize| (0..side).map(|column| map.solid_angle(column, row)).sum::<f64>();
        assert_abs_diff_eq!(6.0 * (0..side).map(row).sum::<f64>(), 4.0 * PI, epsilon = 2e-14);
        assert_eq!(map.len(), 6 * side * side);
    }
    // The solid angle of a fine map's corner texel is 3^(3/2) times smaller than the middle texel's.
    let map = CubeMap::new(2001);
    assert_abs_diff_eq!(map.solid_angle(1000, 1000) / map.solid_angle(0, 0), 27f64.sqrt(), epsilon = 0.01);
}

/// The texels cover the hemisphere, and also the directions between the horizon and the square's sides.
#[test]
fn texels_of_a_parabolic_map_cover_the_square() {
    let map = ParabolicMap::new(32);
    let row = |row: usize| (0..32).map(|column| map.solid_angle(column, row)).sum::<f64>();
    let whole: f64 = (0..32).map(row).sum();
    // Stereographic projection maps the square's sides to circles in planes at 45 degrees, which meet at -z.
    let expected = 16.0 / 2f64.sqrt() * atan2(1.0, 2f64.sqrt());
    assert_abs_diff_eq!(whole, expected, epsilon = 1e-14);
    let above = (0..32 * 32).map(|at| (at % 32, at / 32)).filter(|&(column, row)| map.direction(column, row).z > 0.0);
    let above: f64 = above.map(|(column, row)| map.solid_angle(column, row)).sum();
    assert!((above / (2.0 * PI) - 1.0).abs() < 0.01, "to the rim's texels: {above}");
    assert!(
        map.direction(0, 0).z < -0.3 && map.direction(0, 16).z > 0.0,
        "texels beyond the rim look below the horizon"
    );
}
