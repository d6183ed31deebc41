//! Distant light of any kind.

use glam::{DMat3, DVec3};

use super::cube_light::{fine_disks, fine_samples, red_and_blue_disks, sky_radiance, sun_disk};
use super::{CubeLight, DiskSource};
use crate::error::InputError;
use crate::sphere::{ClearSky, EnvironmentPicture, HarmonicLight};
use crate::transfer::grid::{FINE_DIRECTIONS, light_texel};
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
    /// Radiances of the cube's texels, as in [`CubeLight`].
    Texels(CubeLight),
}

impl DistantLight {
    /// The cube of texels of the light.
    pub fn cube(&self) -> Result<CubeLight, InputError> {
        match self {
            Self::Constant(radiance) => CubeLight::constant(*radiance),
            Self::Disks(sources) => CubeLight::from_disks(sources, &DMat3::IDENTITY),
            Self::Sky(sky) => CubeLight::sky(sky),
            Self::RedAndBlue => CubeLight::red_and_blue(),
            Self::Picture(picture) => CubeLight::from_picture(picture),
            Self::Texels(light) => Ok(light.clone()),
        }
    }

    /// The radiances in the fine directions, 4 x 4 per texel, which [`Self::cube`] averages.
    pub fn fine(&self) -> Result<Vec<[f64; 3]>, InputError> {
        let disks = |sources: &[DiskSource]| fine_disks(sources, &DMat3::IDENTITY);
        match self {
            Self::Constant(radiance) => fine_samples(|_| *radiance),
            Self::Disks(sources) => disks(sources),
            Self::Sky(sky) => {
                sky.relative(DVec3::Z).map_err(of_light)?;
                let without_sun = fine_samples(|v| sky_radiance(sky, v))?;
                Ok(sum(&without_sun, &disks(&[sun_disk(sky)])?))
            }
            Self::RedAndBlue => {
                let surrounding = vec![HarmonicLight::RED_AND_BLUE_SURROUNDING; FINE_DIRECTIONS];
                Ok(sum(&disks(&red_and_blue_disks())?, &surrounding))
            }
            Self::Picture(picture) => fine_samples(|v| picture.radiance(v)),
            Self::Texels(light) => Ok((0..FINE_DIRECTIONS).map(|fine| light.texels()[light_texel(fine)]).collect()),
        }
    }
}

fn sum(one: &[[f64; 3]], other: &[[f64; 3]]) -> Vec<[f64; 3]> {
    one.iter().zip(other).map(|(a, b)| [a[0] + b[0], a[1] + b[1], a[2] + b[2]]).collect()
}
