//! Distant light from pictures of the whole sphere, and lookups in them.

use glam::DVec3;

use super::layout::{EnvironmentLayout, LayoutGrid};
use super::light::HarmonicLight;
use super::texels::project;
use crate::error::{InputError, input_error};
use crate::picture::Picture;

impl HarmonicLight {
    /// Projects a picture of the whole sphere, with constant radiance over each pixel. Its shape determines its layout.
    /// Pixels that show no direction are not read.
    ///
    /// # Errors
    /// [`InputError`] if no layout has the shape, there is no color, or a pixel is NaN or infinite.
    ///
    /// # Panics
    /// If the order is not 1 to 10.
    pub fn from_picture(order: usize, picture: &Picture) -> Result<Self, InputError> {
        let (grid, pixels) = read(picture)?;
        Ok(Self::projected(project(&grid, order, &pixels)))
    }
}

/// Picture of the whole sphere for lookups of radiance by direction: constant over each pixel.
#[derive(Debug)]
pub struct EnvironmentPicture {
    grid: LayoutGrid,
    pixels: Vec<[f32; 3]>,
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

/// Reads the pixels of a picture of the whole sphere, and its layout.
fn read(picture: &Picture) -> Result<(LayoutGrid, Vec<[f32; 3]>), InputError> {
    let [width, height] = [picture.width(), picture.height()];
    let layout = EnvironmentLayout::of(width, height).ok_or_else(|| {
        input_error!("crossbar::sphere::shape" =>
            "expected a lat-long picture (width twice the height), an angular probe (a square) or a cube cross (4:3 \
             or 3:4, of whole squares), found {width}x{height}")
    })?;
    let pixels = picture.linear()?;
    let grid = LayoutGrid::new(layout, width as usize, height as usize);
    check(&pixels, width as usize, |column, row| grid.shows(column, row))?;
    Ok((grid, pixels))
}

/// Checks that all texels that show a direction are finite.
fn check(pixels: &[[f32; 3]], columns: usize, shows: impl Fn(usize, usize) -> bool) -> Result<(), InputError> {
    for (at, pixel) in pixels.iter().enumerate() {
        let (column, row) = (at % columns, at / columns);
        for (channel, &found) in ["red", "green", "blue"].into_iter().zip(pixel) {
            if !found.is_finite() && shows(column, row) {
                return Err(input_error!("crossbar::sphere::texel" =>
                    "expected finite radiance, found {found} in channel {channel} of the pixel in column {column}, \
                     row {row} (counted from 0, the top left)"));
            }
        }
    }
    Ok(())
}
