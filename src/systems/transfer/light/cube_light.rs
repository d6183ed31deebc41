//! The texels of a light.

use glam::{DMat3, DVec3};
use rayon::prelude::*;

use super::disks::{DiskSource, add_disk};
use crate::error::{InputError, ensure, input_error};
use crate::picture::Picture;
use crate::sphere::{ClearSky, EnvironmentPicture, HarmonicLight, check_rotation};
use crate::transfer::grid::{FINE_DIRECTIONS, FineDirections, LIGHT_SIDE, LIGHT_TEXELS, face_row_column, light_texel};

/// Distant light: finite red, green and blue of each light texel. Only truncated light ([`Self::signed`]) may have
/// texels below 0.
#[derive(Clone, Debug, PartialEq)]
pub struct CubeLight {
    texels: Vec<[f64; 3]>,
}

impl CubeLight {
    /// Creates a light from radiances by texel index. Fails with [`InputError`] unless there are 6 x 32 x 32, all
    /// finite and at least 0.
    pub fn new(texels: Vec<[f64; 3]>) -> Result<Self, InputError> {
        Self::at_least(0.0, texels)
    }

    /// Creates a light from radiances that may be negative, as in truncated light, which oscillates around 0. Fails
    /// with [`InputError`] unless there are 6 x 32 x 32, all finite.
    pub fn signed(texels: Vec<[f64; 3]>) -> Result<Self, InputError> {
        Self::at_least(f64::NEG_INFINITY, texels)
    }

    fn at_least(least: f64, texels: Vec<[f64; 3]>) -> Result<Self, InputError> {
        ensure!(texels.len() == LIGHT_TEXELS, "crossbar::prt::light" =>
            "expected {LIGHT_TEXELS} texels, six faces of 32x32, found {}", texels.len());
        check(&texels, |texel| texel, least)?;
        Ok(Self { texels })
    }

    /// Creates a light with equal radiance from all directions.
    pub fn constant(radiance: [f64; 3]) -> Result<Self, InputError> {
        Self::new(vec![radiance; LIGHT_TEXELS])
    }

    /// Creates a light from a function of unit directions: the mean over 4 x 4 fine directions of each texel, weighted
    /// by their solid angles, which keeps the flux through the texel. (The paper says "supersample the lighting 4 x 4
    /// and decimate", without weights.) Fails with [`InputError`] if a radiance is negative or not finite.
    pub fn sampled(radiance: impl Fn(DVec3) -> [f64; 3] + Sync) -> Result<Self, InputError> {
        Self::decimated(&fine_samples(radiance)?)
    }

    /// Creates a light from a picture of the whole sphere, with constant radiance over each pixel.
    pub fn from_picture(picture: &EnvironmentPicture) -> Result<Self, InputError> {
        Self::sampled(|direction| picture.radiance(direction))
    }

    /// Creates a light from small sources, after a rotation; errors count the sources from 0. Each adds its radiance
    /// times the covered fraction of each fine texel. The fractions are computed on a grid fine enough for the source,
    /// and scaled so that the source's flux, 2 pi (1 - cos radius) times its radiance, is exact.
    pub fn from_disks(sources: &[DiskSource], rotation: &DMat3) -> Result<Self, InputError> {
        Self::decimated(&fine_disks(sources, rotation)?)
    }

    /// The light of the CIE clear sky over z >= 0 with its sun, and of the ground below. Fails as [`Self::sampled`]
    /// does, and if the sun is not above the horizon.
    pub fn sky(sky: &ClearSky) -> Result<Self, InputError> {
        sky.relative(DVec3::Z).map_err(of_light)?;
        let without_sun = Self::sampled(|v| sky_radiance(sky, v))?;
        Ok(without_sun.plus(&Self::from_disks(&[sun_disk(sky)], &DMat3::IDENTITY)?))
    }

    /// [`HarmonicLight::red_and_blue`] without truncation to an order: two disks in a dim surrounding.
    pub fn red_and_blue() -> Result<Self, InputError> {
        let surrounding = Self::constant(HarmonicLight::RED_AND_BLUE_SURROUNDING)?;
        Ok(Self::from_disks(&red_and_blue_disks(), &DMat3::IDENTITY)?.plus(&surrounding))
    }

    /// Averages samples in all fine directions to texels.
    fn decimated(fine: &[[f64; 3]]) -> Result<Self, InputError> {
        let solid_angles = FineDirections::get().solid_angles();
        let texel = |texel: usize| {
            let (mut sum, mut whole) = ([0.0; 3], 0.0);
            for at in FineDirections::get().in_texel(texel) {
                sum.iter_mut().zip(fine[at]).for_each(|(sum, radiance)| *sum += solid_angles[at] * radiance);
                whole += solid_angles[at];
            }
            sum.map(|sum| sum / whole)
        };
        Self::signed((0..LIGHT_TEXELS).map(texel).collect())
    }

    /// The sum of both lights.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        let both = self.texels.iter().zip(&other.texels);
        Self { texels: both.map(|(a, b)| [a[0] + b[0], a[1] + b[1], a[2] + b[2]]).collect() }
    }

    /// The radiances by texel index.
    pub fn texels(&self) -> &[[f64; 3]] {
        &self.texels
    }

    /// The light in harmonics, each integrated over the texels, from radiances in single precision. Panics if the order
    /// is not 1 to 10.
    pub fn harmonics(&self, order: usize) -> Result<HarmonicLight, InputError> {
        let single: Vec<[f32; 3]> = self.texels.iter().map(|texel| texel.map(|value| value as f32)).collect();
        HarmonicLight::from_picture(order, &Picture::rgb(LIGHT_SIDE as u32, 6 * LIGHT_SIDE as u32, &single))
    }

    /// The integral over all directions of the radiance, which is constant over each texel.
    pub fn flux(&self) -> [f64; 3] {
        let solid_angles = FineDirections::get().solid_angles();
        let mut sum = [0.0; 3];
        for (fine, solid_angle) in solid_angles.iter().enumerate() {
            let radiance = self.texels[light_texel(fine)];
            sum.iter_mut().zip(radiance).for_each(|(sum, radiance)| *sum += solid_angle * radiance);
        }
        sum
    }
}

/// Samples a function of unit directions in all fine directions and checks it.
pub(super) fn fine_samples(radiance: impl Fn(DVec3) -> [f64; 3] + Sync) -> Result<Vec<[f64; 3]>, InputError> {
    let fine: Vec<[f64; 3]> =
        FineDirections::get().directions().par_iter().map(|&direction| radiance(direction)).collect();
    // An invalid sample might not be visible in the mean of sixteen.
    check(&fine, light_texel, 0.0)?;
    Ok(fine)
}

/// The mean radiances of disks over all fine texels.
pub(super) fn fine_disks(sources: &[DiskSource], rotation: &DMat3) -> Result<Vec<[f64; 3]>, InputError> {
    check_rotation(rotation).map_err(of_light)?;
    let mut fine = vec![[0.0; 3]; FINE_DIRECTIONS];
    for (number, source) in sources.iter().enumerate() {
        add_disk(&source.checked(number)?, rotation, &mut fine);
    }
    Ok(fine)
}

/// The clear sky without its sun, and the ground below.
pub(super) fn sky_radiance(sky: &ClearSky, direction: DVec3) -> [f64; 3] {
    match direction.z >= 0.0 {
        true => sky.zenith.map(|zenith| zenith * sky.relative(direction).unwrap_or(0.0)),
        false => sky.ground,
    }
}

pub(super) fn sun_disk(sky: &ClearSky) -> DiskSource {
    DiskSource { towards: sky.sun, radius: crate::sphere::SUN_RADIUS, radiance: sky.sun_radiance }
}

pub(super) fn red_and_blue_disks() -> [DiskSource; 2] {
    HarmonicLight::RED_AND_BLUE_DISKS.map(|(towards, radiance)| DiskSource {
        towards,
        radius: HarmonicLight::RED_AND_BLUE_RADIUS,
        radiance,
    })
}

/// Rejects radiances that are not finite, or lie below `least`; `texel` gives the light texel of each.
fn check(radiances: &[[f64; 3]], texel: impl Fn(usize) -> usize, least: f64) -> Result<(), InputError> {
    for (at, color) in radiances.iter().enumerate() {
        for (channel, &found) in ["red", "green", "blue"].into_iter().zip(color) {
            if !(found.is_finite() && found >= least) {
                let [face, row, column] = face_row_column(texel(at), LIGHT_SIDE);
                return Err(input_error!("crossbar::prt::light" =>
                    "expected a finite radiance of at least 0, found {found} in channel {channel} of face {face}, \
                     row {row}, column {column} (counted from 0)"));
            }
        }
    }
    Ok(())
}

/// Converts an error of a sky or a rotation.
pub(super) fn of_light(error: InputError) -> InputError {
    error.coded("crossbar::prt::light")
}
