//! Rotated light.

use crossbar_systems::transfer::grid::{LIGHT_MAP, LIGHT_SIDE, LIGHT_TEXELS};
use crossbar_systems::transfer::light::{CubeLight, Decimation, DistantLight};
use glam::{DMat3, DVec3};

fn texel(direction: DVec3) -> usize {
    let [face, column, row] = LIGHT_MAP.texel_of(direction);
    (face * LIGHT_SIDE + row) * LIGHT_SIDE + column
}

/// Texels turn with the cube; truncated light has texels below 0, which stay unchanged.
#[test]
fn texels_of_any_sign_turn_with_the_cube() {
    // A quarter turn around z takes +x to +y: the middle of face +x moves to the middle of face +y.
    let turn = DMat3::from_cols(DVec3::Y, DVec3::NEG_X, DVec3::Z);
    for sign in [1.0, -1.0] {
        let texels: Vec<[f64; 3]> = (0..LIGHT_TEXELS).map(|at| [sign * at as f64, 1.0, sign * 0.5]).collect();
        let light = if sign > 0.0 { CubeLight::new(texels.clone()) } else { CubeLight::signed(texels.clone()) };
        let light = DistantLight::Texels(light.expect("light"));
        for decimation in [Decimation::SolidAngle, Decimation::Plain] {
            assert_eq!(light.cube(&DMat3::IDENTITY, decimation).expect("light").texels(), &texels[..]);
        }
        let turned = light.cube(&turn, Decimation::SolidAngle).expect("light");
        for direction in [DVec3::new(1.0, 0.3, -0.2), DVec3::new(-0.1, 0.2, 1.0), DVec3::new(0.4, -1.0, 0.6)] {
            let found = turned.texels()[texel(turn * direction)][0];
            assert!((found - sign * texel(direction) as f64).abs() < 1e-9, "{direction}");
        }
    }
}
