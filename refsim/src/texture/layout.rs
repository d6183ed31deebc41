//! Memory layouts of textures on the card.
//!
//! Values never depend on the layout: an [`Image`] stores its texels row by row. Only the timing model's texture cache
//! uses the layout, because a cache line holds texels that are adjacent in memory.

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
    /// of 8x8 micro tiles (2 KiB), both row by row, as in R300's open driver. Levels that are smaller than a macro tile
    /// in either direction only have micro tiles.
    Tiles,
}

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
