//! Distant light that can be rotated.

use glam::{DMat3, DVec3};

use super::cube_light::{fine_disks, fine_samples, red_and_blue_disks, sky_radiance, sun_disk};
use super::{CubeLight, Decimation, DiskSource};
use crate::error::InputError;
use crate::sphere::{ClearSky, EnvironmentPicture, HarmonicLight};
use crate::transfer::grid::FINE_DIRECTIONS;
use crate::transfer::light::cube_light::of_light;

/// Distant light, before it is sampled by the cube's texels.
#[derive(Debug)]
pub enum DistantLight {
    /// Equal radiance from all directions.
    Constant([f64; 3]),
    /// Disks in black surroundings.
    Disks(Vec<DiskSource>),
    /// A clear sky with a sun.
    Sky(ClearSky),
    /// A red and a blue disk in dim light.
    RedAndBlue,
    /// A picture of all directions.
    Picture(EnvironmentPicture),
    /// Radiances of the cube's texels, as in [`CubeLight`]. After a rotation, a direction has the radiance of the texel
    /// that contains it.
    Texels(CubeLight),
}

impl DistantLight {
    /// The cube of texels of the rotated light.
    pub fn cube(&self, rotation: &DMat3, decimation: Decimation) -> Result<CubeLight, InputError> {
        match self {
            Self::Constant(radiance) => CubeLight::constant(*radiance),
            Self::Disks(sources) => CubeLight::from_disks(sources, rotation, decimation),
            Self::Sky(sky) => CubeLight::sky(sky, rotation, decimation),
            Self::RedAndBlue => CubeLight::red_and_blue(rotation, decimation),
            Self::Picture(picture) => CubeLight::from_picture(picture, rotation, decimation),
            Self::Texels(light) if *rotation == DMat3::IDENTITY => Ok(light.clone()),
            Self::Texels(light) => light.turned(rotation, decimation),
        }
    }

    /// The radiances in the fine directions, 4 x 4 per texel, which [`Self::cube`] averages.
    pub fn fine(&self, rotation: &DMat3) -> Result<Vec<[f64; 3]>, InputError> {
        match self {
            Self::Constant(radiance) => fine_samples(|_| *radiance, rotation, 0.0),
            Self::Disks(sources) => fine_disks(sources, rotation),
            Self::Sky(sky) => {
                sky.relative(DVec3::Z).map_err(of_light)?;
                let without_sun = fine_samples(|v| sky_radiance(sky, v), rotation, 0.0)?;
                Ok(sum(&without_sun, &fine_disks(&[sun_disk(sky)], rotation)?))
            }
            Self::RedAndBlue => {
                let surrounding = vec![HarmonicLight::RED_AND_BLUE_SURROUNDING; FINE_DIRECTIONS];
                Ok(sum(&fine_disks(&red_and_blue_disks(), rotation)?, &surrounding))
            }
            Self::Picture(picture) => fine_samples(|v| picture.radiance(v), rotation, 0.0),
            Self::Texels(light) => light.fine(rotation),
        }
    }
}

fn sum(one: &[[f64; 3]], other: &[[f64; 3]]) -> Vec<[f64; 3]> {
    one.iter().zip(other).map(|(a, b)| [a[0] + b[0], a[1] + b[1], a[2] + b[2]]).collect()
}
