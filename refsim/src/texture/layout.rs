//! Memory layouts of textures on the card.
//!
//! Values never depend on the layout: an [`Image`] stores its texels row by row. Only the timing model's texture cache
//! uses it, because a cache line holds texels that are adjacent in memory.

use super::Image;

/// Size of a micro tile, and alignment of levels and rows, in bytes.
const MICRO_BYTES: u64 = 32;
/// Micro tiles per side of a macro tile.
const MACRO_SIDE: u64 = 8;

/// Arrangement of the texels of a level.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Layout {
    /// Row by row, with rows padded to 32 bytes.
    #[default]
    Rows,
    /// Micro tiles of 32 bytes (8-bit texels 8x4, 16-bit 8x2, 32-bit 4x2, 64-bit 2x2, 128-bit 2x1) within macro tiles
    /// of 8x8 micro tiles (2 KiB), both row by row; as in R300's open driver. Levels smaller than a macro tile in
    /// either direction have micro tiles only.
    Tiles,
}

/// Layout of one level.
#[derive(Clone, Copy, Debug)]
struct LevelMap {
    start: u64,
    slice: u64,
    /// Bytes per row of texels, micro tiles or macro tiles.
    row: u64,
    macros: bool,
}

/// Maps texels of an image to addresses in the card's memory.
#[derive(Clone, Debug)]
pub struct TexelMap {
    layout: Layout,
    texel: u64,
    micro: [u64; 2],
    levels: Vec<LevelMap>,
    bytes: u64,
}

impl TexelMap {
    /// Creates the map of an image with a layout.
    pub fn new(layout: Layout, image: &Image) -> Self {
        // All formats have 1, 2, 4, 8 or 16 bytes per texel.
        let texel = (image.format().bytes() as u64).next_power_of_two();
        let micro = match texel {
            1 => [8, 4],
            2 => [8, 2],
            4 => [4, 2],
            8 => [2, 2],
            _ => [2, 1],
        };
        let mut levels = Vec::with_capacity(image.levels().len());
        let mut bytes = 0;
        for level in image.levels() {
            let (width, height) = (u64::from(level.width), u64::from(level.height));
            let [wide, high] = micro.map(|side| side * MACRO_SIDE);
            let macros = layout == Layout::Tiles && width >= wide && height >= high;
            let (row, rows) = match layout {
                Layout::Rows => ((width * texel).next_multiple_of(MICRO_BYTES), height),
                Layout::Tiles if macros => {
                    (width.div_ceil(wide) * MICRO_BYTES * MACRO_SIDE * MACRO_SIDE, height.div_ceil(high))
                }
                Layout::Tiles => (width.div_ceil(micro[0]) * MICRO_BYTES, height.div_ceil(micro[1])),
            };
            let slice = row * rows;
            levels.push(LevelMap { start: bytes, slice, row, macros });
            bytes += slice * u64::from(level.slices);
        }
        Self { layout, texel, micro, levels, bytes }
    }

    /// Size of the image in memory, in bytes, including padding.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Bytes per texel.
    pub fn texel_bytes(&self) -> u32 {
        self.texel as u32
    }

    /// Byte offset of a texel from the start of the image; 0 for a nonexistent level.
    pub fn offset(&self, level: u32, slice: u32, y: u32, x: u32) -> u64 {
        let Some(map) = self.levels.get(level as usize) else { return 0 };
        let start = map.start + map.slice * u64::from(slice);
        let (x, y) = (u64::from(x), u64::from(y));
        if self.layout == Layout::Rows {
            return start + map.row * y + x * self.texel;
        }
        let [width, height] = self.micro;
        let within = (y % height * width + x % width) * self.texel;
        let (column, row) = (x / width, y / height);
        if !map.macros {
            return start + map.row * row + column * MICRO_BYTES + within;
        }
        let micro = (row % MACRO_SIDE * MACRO_SIDE + column % MACRO_SIDE) * MICRO_BYTES;
        let tile = column / MACRO_SIDE * MICRO_BYTES * MACRO_SIDE * MACRO_SIDE;
        start + map.row * (row / MACRO_SIDE) + tile + micro + within
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::{TexelFormat, TextureKind};
    use std::collections::BTreeSet;

    #[test]
    fn every_texel_has_a_place_of_its_own() {
        for layout in [Layout::Rows, Layout::Tiles] {
            for format in
                [TexelFormat::L8, TexelFormat::Bgr565, TexelFormat::Rgba8, TexelFormat::Rgba16, TexelFormat::Rgba32f]
            {
                let image = Image::new(format, TextureKind::D2, [70, 37, 1], 7).unwrap();
                let map = TexelMap::new(layout, &image);
                let mut seen = BTreeSet::new();
                for (n, level) in (0..).zip(image.levels()) {
                    for (y, x) in (0..level.height).flat_map(|y| (0..level.width).map(move |x| (y, x))) {
                        let at = map.offset(n, 0, y, x);
                        assert!(at.is_multiple_of(map.texel_bytes().into()) && at < map.bytes());
                        assert!(seen.insert(at), "{layout:?} {format}: two texels at {at}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_micro_tile_is_32_bytes_and_a_macro_tile_2_kib() {
        let image = Image::new_2d(TexelFormat::Rgba8, 64, 64).unwrap();
        let map = TexelMap::new(Layout::Tiles, &image);
        assert_eq!([(0, 0), (0, 3), (1, 0), (1, 3)].map(|(y, x)| map.offset(0, 0, y, x)), [0, 12, 16, 28]);
        assert_eq!(
            (map.offset(0, 0, 0, 4), map.offset(0, 0, 2, 0)),
            (32, 256),
            "the next micro tile, and the next row of them"
        );
        assert_eq!(
            (map.offset(0, 0, 0, 32), map.offset(0, 0, 16, 0)),
            (2048, 4096),
            "the next macro tile, and row of them"
        );
    }
}
