//! Distant light from pictures of the whole sphere.

use thiserror::Error;

use super::cube::CubeMap;
use super::layout::{EnvironmentLayout, LayoutGrid};
use super::light::HarmonicLight;
use super::texels::project;
use crate::picture::{Picture, PictureError};

/// Error of reading a picture as light.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Error, miette::Diagnostic)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum EnvironmentError {
    /// No layout has pictures of this shape.
    #[error(
        "expected a lat-long picture (width twice the height), an angular probe (a square) or a cube cross (4:3 or 3:4, of whole squares), found {width}x{height}"
    )]
    #[diagnostic(code(crossbar::sphere::shape))]
    Shape { width: u32, height: u32 },
    /// The layout differs from the required one.
    #[error("expected the shape of a {expected}, found {width}x{height}, that of a {found}")]
    #[diagnostic(code(crossbar::sphere::layout))]
    Layout { expected: EnvironmentLayout, found: EnvironmentLayout, width: u32, height: u32 },
    /// The radiance of a texel is not finite.
    #[error(
        "expected finite radiance, found {found} in channel {channel} of the pixel in column {column}, row {row} (counted from 0, the top left)"
    )]
    #[diagnostic(code(crossbar::sphere::texel))]
    NotFinite { channel: &'static str, column: usize, row: usize, found: f32 },
    /// The number of texels is not that of the cube map.
    #[error("expected {expected} texels, six faces of {side}x{side}, found {found}")]
    #[diagnostic(code(crossbar::sphere::texels))]
    Texels { side: usize, expected: usize, found: usize },
    /// The picture has no color channels.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Picture(#[from] PictureError),
}

impl HarmonicLight {
    /// Projects a picture of the whole sphere, with constant radiance over each pixel. Its shape determines its layout.
    /// Pixels that show no direction are not read.
    ///
    /// # Errors
    /// [`EnvironmentError`] if no layout has the shape, there is no color, or a pixel is NaN or infinite.
    ///
    /// # Panics
    /// If the order is not 1 to 10.
    pub fn from_picture(order: usize, picture: &Picture) -> Result<Self, EnvironmentError> {
        let (grid, pixels) = read(picture)?;
        Ok(Self::projected(project(&grid, order, |at| pixels[at])))
    }

    /// Like [`Self::from_picture`], for a picture that must have a given layout.
    ///
    /// # Errors
    /// [`EnvironmentError`], also for another layout.
    ///
    /// # Panics
    /// If the order is not 1 to 10.
    pub fn from_picture_of(
        expected: EnvironmentLayout,
        order: usize,
        picture: &Picture,
    ) -> Result<Self, EnvironmentError> {
        let [width, height] = [picture.width(), picture.height()];
        match EnvironmentLayout::of(width, height) {
            Some(found) if found != expected => Err(EnvironmentError::Layout { expected, found, width, height }),
            _ => Self::from_picture(order, picture),
        }
    }

    /// Projects a cube map's texels, face by face in Direct3D's order, rows from the top.
    ///
    /// # Errors
    /// [`EnvironmentError`] if their number is not that of the map, or one is NaN or infinite.
    ///
    /// # Panics
    /// If the order is not 1 to 10.
    pub fn from_cube_map(order: usize, map: CubeMap, texels: &[[f32; 3]]) -> Result<Self, EnvironmentError> {
        let (side, expected, found) = (map.side(), map.len(), texels.len());
        if found != expected {
            return Err(EnvironmentError::Texels { side, expected, found });
        }
        check(texels, side, |_, _| true)?;
        Ok(Self::projected(project(&map, order, |at| texels[at])))
    }
}

/// Reads the pixels of a picture of the whole sphere, and its layout.
pub(super) fn read(picture: &Picture) -> Result<(LayoutGrid, Vec<[f32; 3]>), EnvironmentError> {
    let [width, height] = [picture.width(), picture.height()];
    let layout = EnvironmentLayout::of(width, height).ok_or(EnvironmentError::Shape { width, height })?;
    let pixels = picture.linear()?;
    let grid = LayoutGrid::new(layout, width as usize, height as usize);
    check(&pixels, width as usize, |column, row| grid.shows(column, row))?;
    Ok((grid, pixels))
}

/// Checks that all texels that show a direction are finite.
fn check(pixels: &[[f32; 3]], columns: usize, shows: impl Fn(usize, usize) -> bool) -> Result<(), EnvironmentError> {
    for (at, pixel) in pixels.iter().enumerate() {
        let (column, row) = (at % columns, at / columns);
        for (channel, &found) in ["red", "green", "blue"].into_iter().zip(pixel) {
            if !found.is_finite() && shows(column, row) {
                return Err(EnvironmentError::NotFinite { channel, column, row, found });
            }
        }
    }
    Ok(())
}
