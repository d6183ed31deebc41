//! Batches of rays, laid out as rectangles of pixels.

use refsim::texture::Region;

use crate::error::{InputError, ensure};
use crate::geom::Ray;

/// Side of the squares in which lists are laid out, in pixels: a tile of the card, and the paper's bucket of 256 rays
/// (section 5.3).
const SQUARE: usize = 16;
/// Squares per row of a list's batch.
const SQUARES_A_ROW: usize = 16;

/// Rays as a rectangle of pixels, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct RayBatch {
    width: u32,
    height: u32,
    rays: Vec<Ray>,
}

impl RayBatch {
    /// Creates a batch of `width * height` rays, row by row. Fails with [`InputError`] for another number of rays.
    pub fn new(width: u32, height: u32, rays: Vec<Ray>) -> Result<Self, InputError> {
        ensure!(rays.len() == width as usize * height as usize, "ray_engine::batch" =>
            "expected {width} x {height} rays for a batch of that size, found {}", rays.len());
        Ok(Self { width, height, rays })
    }

    /// Creates a batch of full rows of `width` rays; drops the remaining rays.
    pub fn rows(width: u32, mut rays: Vec<Ray>) -> Self {
        let height = rays.len() / (width as usize).max(1);
        rays.truncate(width as usize * height);
        Self { width, height: u32::try_from(height).unwrap_or(u32::MAX), rays }
    }

    /// Lays out a list of rays in squares of 16 x 16 pixels, 256 rays each, 16 squares per row: neighbours in the list
    /// are neighbours on the screen. The last square is padded with the last ray; [`Self::pixel_of`] maps rays of the
    /// list to pixels. An empty list gives a batch of no rows.
    pub fn from_list(rays: &[Ray]) -> Self {
        let squares = rays.len().div_ceil(SQUARE * SQUARE);
        let columns = squares.clamp(1, SQUARES_A_ROW);
        let (width, height) = (columns * SQUARE, squares.div_ceil(columns) * SQUARE);
        let mut pixels: Vec<Ray> = rays.last().into_iter().cycle().take(width * height).copied().collect();
        for (i, ray) in rays.iter().enumerate() {
            pixels[Self::pixel_in(width, i)] = *ray;
        }
        let side = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
        Self { width: side(width), height: side(height), rays: pixels }
    }

    /// Returns the pixel, counted row by row, of ray `ray` of the list given to [`Self::from_list`].
    pub const fn pixel_of(&self, ray: usize) -> usize {
        Self::pixel_in(self.width as usize, ray)
    }

    const fn pixel_in(width: usize, ray: usize) -> usize {
        let (square, within) = (ray / (SQUARE * SQUARE), ray % (SQUARE * SQUARE));
        let columns = width / SQUARE;
        let (x, y) = (square % columns * SQUARE + within % SQUARE, square / columns * SQUARE + within / SQUARE);
        y * width + x
    }

    /// Number of columns.
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// Number of rows.
    pub const fn height(&self) -> u32 {
        self.height
    }

    /// Rays, row by row.
    pub fn rays(&self) -> &[Ray] {
        &self.rays
    }

    /// Returns the rays of a region as a batch; the part of the region outside the batch is clipped.
    pub(super) fn part(&self, region: Region) -> Self {
        let whole = Region { x: 0, y: 0, width: self.width, height: self.height };
        let Region { x, y, width, height } = region.intersect(whole);
        let rows = self.rays.chunks(self.width.max(1) as usize).skip(y as usize).take(height as usize);
        let rays = rows.flat_map(|row| &row[x as usize..(x + width) as usize]).copied().collect();
        Self { width, height, rays }
    }

    /// Returns the common origin of all rays, if there is one: eye rays, or rays from a point light.
    pub fn common_origin(&self) -> Option<[f32; 3]> {
        let first = self.rays.first()?.origin();
        self.rays.iter().all(|r| r.origin() == first).then_some(first)
    }
}
