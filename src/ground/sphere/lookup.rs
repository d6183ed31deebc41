//! Lookup of a picture's radiance in a direction.

use glam::DVec3;

use super::environment::read;
use super::layout::LayoutGrid;
use crate::error::InputError;
use crate::picture::Picture;

/// Picture of the whole sphere for lookups of radiance by direction: constant over each pixel.
pub struct EnvironmentPicture {
    grid: LayoutGrid,
    pixels: Vec<[f32; 3]>,
}

impl std::fmt::Debug for EnvironmentPicture {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("EnvironmentPicture").field("pixels", &self.pixels.len()).finish_non_exhaustive()
    }
}

impl EnvironmentPicture {
    /// Reads a picture, whose shape determines its layout. Pixels that show no direction are not read.
    ///
    /// # Errors
    /// [`InputError`] if no layout has the shape, there is no color, or a pixel is NaN or infinite.
    pub fn new(picture: &Picture) -> Result<Self, InputError> {
        let (grid, pixels) = read(picture)?;
        Ok(Self { grid, pixels })
    }

    /// Radiance in a unit direction: red, green and blue.
    pub fn radiance(&self, direction: DVec3) -> [f64; 3] {
        self.pixels[self.grid.pixel(direction)].map(f64::from)
    }
}
