//! Copies of a rectangle of all targets, so that tiles can be drawn in parallel.

use super::depth::{DepthFormat, DepthSurface};
use super::{MAX_TARGETS, OutputError};
use crate::texture::{Image, Region, TexelFormat, TextureError, TextureKind, image};

/// Texels of one colour target within a tile.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ColorTile {
    /// The texel format.
    pub format: TexelFormat,
    /// Texels row by row, little-endian, as in [`Image`].
    pub bytes: Vec<u8>,
}

/// Patterns of the depth buffer within a tile.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DepthTile {
    /// The depth format.
    pub format: DepthFormat,
    /// Patterns row by row.
    pub data: Vec<u32>,
}

/// Copies of all targets of a draw within a rectangle of pixels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TargetTile {
    /// The rectangle, in pixels.
    pub region: Region,
    /// Colour targets in order; `None` for unused slots.
    pub colors: [Option<ColorTile>; MAX_TARGETS],
    /// The depth buffer.
    pub depth: Option<DepthTile>,
}

impl TargetTile {
    /// Checks that images and depth surface can be the targets of one draw; returns their common region.
    ///
    /// # Errors
    /// If there are more than four colour targets, one is not two-dimensional, or sizes differ.
    pub fn check(colors: &[Option<&Image>], depth: Option<&DepthSurface>) -> Result<Region, OutputError> {
        if colors.len() > MAX_TARGETS {
            return Err(OutputError::TooManyTargets { most: MAX_TARGETS, found: colors.len() });
        }
        let mut sizes = Vec::new();
        for (index, image) in colors.iter().enumerate().filter_map(|(i, c)| c.map(|c| (i, c))) {
            if !matches!(image.kind(), TextureKind::D2 | TextureKind::Rectangle) {
                return Err(OutputError::TargetKind { index, kind: image.kind() });
            }
            sizes.push((image.width(), image.height()));
        }
        sizes.extend(depth.map(|d| (d.width(), d.height())));
        let Some(&(width, height)) = sizes.first() else { return Ok(Region::default()) };
        let expected = Region { x: 0, y: 0, width, height };
        match sizes.iter().find(|&&s| s != (width, height)) {
            Some(&(width, height)) => Err(OutputError::TargetSize { expected, width, height }),
            None => Ok(expected),
        }
    }

    /// Copies a rectangle from the targets.
    ///
    /// # Errors
    /// As [`TargetTile::check`]. A rectangle beyond the targets is clipped, which is not an error.
    pub fn load(colors: &[Option<&Image>], depth: Option<&DepthSurface>, region: Region) -> Result<Self, OutputError> {
        let region = region.intersect(Self::check(colors, depth)?);
        let mut tile = Self { region, colors: [const { None }; MAX_TARGETS], depth: None };
        for (slot, image) in tile.colors.iter_mut().zip(colors) {
            *slot = image.and_then(|image| {
                let bytes = image.read_region(0, 0, region).ok()?;
                Some(ColorTile { format: image.format(), bytes })
            });
        }
        tile.depth = depth.map(|surface| {
            let rows = (region.y..region.y + region.height).flat_map(|y| {
                let start = y as usize * surface.width() as usize + region.x as usize;
                &surface.data()[start..start + region.width as usize]
            });
            DepthTile { format: surface.format(), data: rows.copied().collect() }
        });
        Ok(tile)
    }

    /// Copies the tile's pixels of colour target `index` back to the image.
    ///
    /// # Errors
    /// If the image's size or format differs from the loaded image's.
    pub fn store_color(&self, index: usize, image: &mut Image) -> Result<(), TextureError> {
        match self.colors.get(index) {
            Some(Some(tile)) => image.write_region(0, 0, self.region, &tile.bytes),
            _ => Ok(()),
        }
    }

    /// Copies the tile's depths back to the surface; does nothing if the tile exceeds it.
    pub fn store_depth(&self, surface: &mut DepthSurface) {
        let Some(tile) = &self.depth else { return };
        let (stride, r) = (surface.width() as usize, self.region);
        if r.x + r.width > surface.width() || r.y + r.height > surface.height() || r.width == 0 {
            return;
        }
        for (row, y) in tile.data.chunks_exact(r.width as usize).zip(r.y..) {
            let start = y as usize * stride + r.x as usize;
            surface.data_mut()[start..start + row.len()].copy_from_slice(row);
        }
    }

    /// Index of a pixel within the tile; `None` outside.
    pub fn index(&self, x: u32, y: u32) -> Option<usize> {
        let r = &self.region;
        let inside = x >= r.x && y >= r.y && x - r.x < r.width && y - r.y < r.height;
        inside.then(|| (y - r.y) as usize * r.width as usize + (x - r.x) as usize)
    }
}

impl ColorTile {
    /// The texel at an index from [`TargetTile::index`], as a little-endian integer; 0 past the end.
    pub fn raw(&self, index: usize) -> u128 {
        let size = self.format.bytes();
        self.bytes.get(index * size..(index + 1) * size).map_or(0, image::read_le)
    }

    /// Overwrites the texel at an index; does nothing past the end.
    pub fn set_raw(&mut self, index: usize, raw: u128) {
        let size = self.format.bytes();
        if let Some(bytes) = self.bytes.get_mut(index * size..(index + 1) * size) {
            bytes.copy_from_slice(&raw.to_le_bytes()[..size]);
        }
    }
}
