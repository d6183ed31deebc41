//! Light that can be turned.

use glam::{DMat3, DVec3};

use super::{CubeLight, CubeLightError, Decimation, DiskSource};
use crate::prt::all_frequency::grid::{LIGHT_MAP, LIGHT_SIDE};
use crate::sphere::{ClearSky, EnvironmentPicture};

/// Distant light, before it is sampled by the cube's texels.
#[derive(Debug)]
pub enum DistantLight {
    /// The same radiance from everywhere.
    Constant([f64; 3]),
    /// Disks in the dark.
    Disks(Vec<DiskSource>),
    /// A clear sky with a sun.
    Sky(ClearSky),
    /// A red and a blue disk in dim light.
    RedAndBlue,
    /// A picture of all directions.
    Picture(EnvironmentPicture),
    /// Radiances of the cube's texels, as in [`CubeLight`]. Turned, a direction has the radiance of the texel that it
    /// falls into.
    Texels(CubeLight),
}

impl DistantLight {
    /// The cube of it, turned by a rotation.
    ///
    /// # Errors
    /// [`CubeLightError`].
    pub fn cube(&self, rotation: &DMat3, decimation: Decimation) -> Result<CubeLight, CubeLightError> {
        match self {
            Self::Constant(radiance) => CubeLight::constant(*radiance),
            Self::Disks(sources) => CubeLight::from_disks(sources, rotation, decimation),
            Self::Sky(sky) => CubeLight::sky(sky, rotation, decimation),
            Self::RedAndBlue => CubeLight::red_and_blue(rotation, decimation),
            Self::Picture(picture) => CubeLight::from_picture(picture, rotation, decimation),
            Self::Texels(light) if *rotation == DMat3::IDENTITY => Ok(light.clone()),
            Self::Texels(light) => CubeLight::sampled(|v| light.texels()[texel(v)], rotation, decimation),
        }
    }
}

/// The texel that a direction falls into.
fn texel(direction: DVec3) -> usize {
    let [face, column, row] = LIGHT_MAP.texel_of(direction);
    (face * LIGHT_SIDE + row) * LIGHT_SIDE + column
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::prt::all_frequency::grid::LIGHT_TEXELS;

    #[test]
    fn texels_turn_with_the_cube() {
        let texels: Vec<[f64; 3]> = (0..LIGHT_TEXELS).map(|at| [at as f64, 1.0, 0.5]).collect();
        let light = DistantLight::Texels(CubeLight::new(texels.clone()).expect("light"));
        let same = light.cube(&DMat3::IDENTITY, Decimation::SolidAngle).expect("light");
        assert_eq!(same.texels(), &texels[..]);
        // A quarter turn around z takes +x to +y: the middle of face +x comes to that of face +y.
        let turn = DMat3::from_cols(DVec3::Y, DVec3::NEG_X, DVec3::Z);
        let turned = light.cube(&turn, Decimation::SolidAngle).expect("light");
        let at = |direction: DVec3| turned.texels()[texel(direction)][0];
        for direction in [DVec3::new(1.0, 0.3, -0.2), DVec3::new(-0.1, 0.2, 1.0), DVec3::new(0.4, -1.0, 0.6)] {
            assert!((at(turn * direction) - texel(direction) as f64).abs() < 1e-9, "{direction}");
        }
    }
}
