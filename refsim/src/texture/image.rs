//! Images: texels in memory, with mip levels, slices and faces.

use std::sync::atomic::{AtomicU64, Ordering};

use super::{SignedTexelMinimum, TargetRounding, Texel, TexelFormat, TextureError, TextureKind, decode, encode};
use crate::num::Format;

/// Maximum extent, in texels.
const MAX_TEXELS: u32 = 16_384;
/// Maximum size of an image, in bytes.
const MAX_BYTES: u64 = 1 << 31;

/// A mip level: its extents and its layout in the bytes of the image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Level {
    /// Width in texels.
    pub width: u32,
    /// Height in texels.
    pub height: u32,
    /// Slices: depth of a volume, 6 for a cube, else 1.
    pub slices: u32,
    /// Byte offset of the level.
    pub offset: usize,
    /// Bytes per row.
    pub row_bytes: usize,
    /// Bytes per slice.
    pub slice_bytes: usize,
}

/// A rectangle of texels or pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Region {
    /// Left column.
    pub x: u32,
    /// Top row.
    pub y: u32,
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

impl Region {
    /// The intersection of two regions, with zero width or height if they are disjoint.
    pub fn intersect(self, other: Self) -> Self {
        let x = self.x.max(other.x);
        let y = self.y.max(other.y);
        let right = (self.x.saturating_add(self.width)).min(other.x.saturating_add(other.width));
        let bottom = (self.y.saturating_add(self.height)).min(other.y.saturating_add(other.height));
        Self { x, y, width: right.saturating_sub(x), height: bottom.saturating_sub(y) }
    }
}

/// A texture or colour target in emulated memory.
///
/// Levels are stored consecutively, each slice by slice and row by row, without padding; texels are little-endian.
/// Level 0 of a [`TextureKind::D2`] or [`TextureKind::Rectangle`] image can be a render target, so rendering to a
/// texture needs no copy. Row 0 is the row with the smallest second coordinate.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    format: TexelFormat,
    kind: TextureKind,
    levels: Vec<Level>,
    bytes: Vec<u8>,
    stamp: Stamp,
}

/// Identifies an image's contents; 0 for none. Images with equal stamps are equal, but equal images may have different
/// stamps.
#[derive(Clone, Debug, Default)]
struct Stamp(u64);

/// All stamps compare equal, so that comparisons of images ignore stamps.
impl PartialEq for Stamp {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Eq for Stamp {}

static LAST_STAMP: AtomicU64 = AtomicU64::new(0);

impl Image {
    /// Creates a zero-filled image. Extents that the kind does not use must be 1 (a cube's depth too).
    ///
    /// # Errors
    /// If the extents are invalid for the kind, zero or above 16384; if there are more levels than in a full chain; or
    /// if the image would exceed 2 GiB.
    pub fn new(
        format: TexelFormat,
        kind: TextureKind,
        [width, height, depth]: [u32; 3],
        level_count: u32,
    ) -> Result<Self, TextureError> {
        check_extents(kind, width, height, depth)?;
        let most = Self::most_levels(kind, [width, height, depth]);
        if level_count == 0 || level_count > most {
            return Err(TextureError::Levels { most, found: level_count });
        }
        let mut levels = Vec::new();
        let mut offset = 0u64;
        for i in 0..level_count {
            let halved = |extent: u32| (extent >> i).max(1);
            let (w, h) = (halved(width), halved(height));
            let slices = if kind == TextureKind::Cube { 6 } else { halved(depth) };
            let row_bytes = u64::from(w) * format.bytes() as u64;
            let slice_bytes = row_bytes * u64::from(h);
            let next = offset + slice_bytes * u64::from(slices);
            if next > MAX_BYTES {
                return Err(TextureError::TooLarge { most: MAX_BYTES, found: next });
            }
            levels.push(Level {
                width: w,
                height: h,
                slices,
                offset: offset as usize,
                row_bytes: row_bytes as usize,
                slice_bytes: slice_bytes as usize,
            });
            offset = next;
        }
        Ok(Self { format, kind, levels, bytes: vec![0; offset as usize], stamp: Stamp::default() })
    }

    /// Maximum number of levels of an image with these extents: a full chain down to one texel.
    pub fn most_levels(kind: TextureKind, [width, height, depth]: [u32; 3]) -> u32 {
        let longest = match kind {
            TextureKind::Rectangle => 1,
            TextureKind::Volume => width.max(height).max(depth),
            _ => width.max(height),
        };
        longest.max(1).ilog2() + 1
    }

    /// Creates a 2-D image with one level.
    ///
    /// # Errors
    /// As [`Image::new`].
    pub fn new_2d(format: TexelFormat, width: u32, height: u32) -> Result<Self, TextureError> {
        Self::new(format, TextureKind::D2, [width, height, 1], 1)
    }

    /// Creates an image from bytes in the layout described at [`Image`].
    ///
    /// # Errors
    /// As [`Image::new`], and if the number of bytes is wrong.
    pub fn from_bytes(
        format: TexelFormat,
        kind: TextureKind,
        extents: [u32; 3],
        level_count: u32,
        bytes: Vec<u8>,
    ) -> Result<Self, TextureError> {
        let mut image = Self::new(format, kind, extents, level_count)?;
        if bytes.len() != image.bytes.len() {
            return Err(TextureError::DataSize { unit: "bytes", expected: image.bytes.len(), found: bytes.len() });
        }
        image.bytes = bytes;
        Ok(image)
    }

    /// Creates an image with one level from red, green, blue and alpha values in number format `from`, each rounded
    /// once.
    ///
    /// # Errors
    /// As [`Image::new`], and if the number of values is wrong.
    pub fn from_values(
        format: TexelFormat,
        kind: TextureKind,
        extents: [u32; 3],
        from: Format,
        values: &[[u32; 4]],
        rounding: TargetRounding,
    ) -> Result<Self, TextureError> {
        let mut image = Self::new(format, kind, extents, 1)?;
        let size = format.bytes();
        let expected = image.bytes.len() / size;
        if values.len() != expected {
            return Err(TextureError::DataSize { unit: "texels", expected, found: values.len() });
        }
        for (bytes, &texel) in image.bytes.chunks_exact_mut(size).zip(values) {
            bytes.copy_from_slice(&encode(format, from, texel, rounding).to_le_bytes()[..size]);
        }
        Ok(image)
    }

    /// Copies the image with `level_count` levels; new levels are zero-filled.
    ///
    /// # Errors
    /// As [`Image::new`].
    pub fn with_levels(&self, level_count: u32) -> Result<Self, TextureError> {
        let depth = if self.kind == TextureKind::Cube { 1 } else { self.slices() };
        let mut image = Self::new(self.format, self.kind, [self.width(), self.height(), depth], level_count)?;
        let kept = image.bytes.len().min(self.bytes.len());
        image.bytes[..kept].copy_from_slice(&self.bytes[..kept]);
        Ok(image)
    }

    /// The texel format.
    pub fn format(&self) -> TexelFormat {
        self.format
    }

    /// The kind of texture.
    pub fn kind(&self) -> TextureKind {
        self.kind
    }

    /// The mip levels, largest first; at least one.
    pub fn levels(&self) -> &[Level] {
        &self.levels
    }

    /// Width of level 0 in texels.
    pub fn width(&self) -> u32 {
        self.levels[0].width
    }

    /// Height of level 0 in texels.
    pub fn height(&self) -> u32 {
        self.levels[0].height
    }

    /// Slices of level 0.
    pub fn slices(&self) -> u32 {
        self.levels[0].slices
    }

    /// The whole of level 0's first slice.
    pub fn region(&self) -> Region {
        Region { x: 0, y: 0, width: self.width(), height: self.height() }
    }

    /// All bytes.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Mutable access to all bytes; every pattern is a valid texel.
    pub fn bytes_mut(&mut self) -> &mut [u8] {
        self.stamp = Stamp::default();
        &mut self.bytes
    }

    /// Assigns a unique stamp to the contents; the next modification removes it.
    pub(crate) fn name_contents(&mut self) {
        if self.stamp.0 == 0 {
            self.stamp = Stamp(LAST_STAMP.fetch_add(1, Ordering::Relaxed) + 1);
        }
    }

    /// The stamp of the contents, if any. Images with the same stamp have equal contents and format.
    pub(crate) fn contents_name(&self) -> Option<u64> {
        Some(self.stamp.0).filter(|&name| name != 0)
    }

    /// Byte offset of a texel; `None` outside the image.
    pub fn offset_of(&self, level: u32, slice: u32, y: u32, x: u32) -> Option<usize> {
        let l = self.levels.get(level as usize)?;
        (slice < l.slices && y < l.height && x < l.width).then(|| {
            l.offset + slice as usize * l.slice_bytes + y as usize * l.row_bytes + x as usize * self.format.bytes()
        })
    }

    /// Reads a texel as a little-endian integer; 0 outside the image.
    pub fn raw(&self, level: u32, slice: u32, y: u32, x: u32) -> u128 {
        let Some(at) = self.offset_of(level, slice, y, x) else { return 0 };
        read_le(&self.bytes[at..at + self.format.bytes()])
    }

    /// Overwrites a texel; does nothing outside the image.
    pub fn set_raw(&mut self, level: u32, slice: u32, y: u32, x: u32, raw: u128) {
        let size = self.format.bytes();
        if let Some(at) = self.offset_of(level, slice, y, x) {
            self.bytes_mut()[at..at + size].copy_from_slice(&raw.to_le_bytes()[..size]);
        }
    }

    /// The exact value of a texel; outside the image, the value of a texel of zero bits.
    pub fn texel(&self, level: u32, slice: u32, y: u32, x: u32, minimum: SignedTexelMinimum) -> Texel {
        decode(self.format, self.raw(level, slice, y, x), minimum)
    }

    /// Encodes and stores red, green, blue and alpha, given in format `from`, each rounded once.
    ///
    /// # Errors
    /// If the coordinates are outside the image.
    pub fn store(
        &mut self,
        [level, slice, y, x]: [u32; 4],
        from: Format,
        values: [u32; 4],
        rounding: TargetRounding,
    ) -> Result<(), TextureError> {
        self.check_region(level, slice, Region { x, y, width: 1, height: 1 })?;
        self.set_raw(level, slice, y, x, encode(self.format, from, values, rounding));
        Ok(())
    }

    /// Fills a level with one value; does nothing if the level does not exist.
    pub fn clear_level(&mut self, level: u32, from: Format, values: [u32; 4], rounding: TargetRounding) {
        let size = self.format.bytes();
        let raw = encode(self.format, from, values, rounding).to_le_bytes();
        let place = self.level_place(level);
        for texel in self.bytes_mut()[place].chunks_exact_mut(size) {
            texel.copy_from_slice(&raw[..size]);
        }
    }

    /// The bytes of a level; empty if the level does not exist.
    pub fn level_bytes(&self, level: u32) -> &[u8] {
        &self.bytes[self.level_place(level)]
    }

    fn level_place(&self, level: u32) -> std::ops::Range<usize> {
        let Some(l) = self.levels.get(level as usize) else { return 0..0 };
        l.offset..l.offset + l.slice_bytes * l.slices as usize
    }

    /// Overwrites a rectangle of one slice with texel bytes, row by row.
    ///
    /// # Errors
    /// If the rectangle exceeds the slice, or the number of bytes is wrong.
    pub fn write_region(&mut self, level: u32, slice: u32, region: Region, bytes: &[u8]) -> Result<(), TextureError> {
        self.check_region(level, slice, region)?;
        let row = region.width as usize * self.format.bytes();
        let expected = row * region.height as usize;
        if bytes.len() != expected {
            return Err(TextureError::DataSize { unit: "bytes", expected, found: bytes.len() });
        }
        for i in 0..region.height {
            let source = &bytes[i as usize * row..][..row];
            if let Some(at) = self.offset_of(level, slice, region.y + i, region.x) {
                self.bytes_mut()[at..at + row].copy_from_slice(source);
            }
        }
        Ok(())
    }

    /// Copies the bytes of a rectangle of one slice, row by row.
    ///
    /// # Errors
    /// If the rectangle exceeds the slice.
    pub fn read_region(&self, level: u32, slice: u32, region: Region) -> Result<Vec<u8>, TextureError> {
        self.check_region(level, slice, region)?;
        let row = region.width as usize * self.format.bytes();
        let mut out = Vec::with_capacity(row * region.height as usize);
        for i in 0..region.height {
            if let Some(at) = self.offset_of(level, slice, region.y + i, region.x) {
                out.extend_from_slice(&self.bytes[at..at + row]);
            }
        }
        Ok(out)
    }

    fn check_region(&self, level: u32, slice: u32, region: Region) -> Result<(), TextureError> {
        let outside =
            |what, found: u64, limit: u32| TextureError::Outside { level, what, found, limit: u64::from(limit) };
        let Some(l) = self.levels.get(level as usize) else {
            return Err(outside("level", u64::from(level), self.levels.len() as u32));
        };
        let (right, bottom) =
            (u64::from(region.x) + u64::from(region.width), u64::from(region.y) + u64::from(region.height));
        if slice >= l.slices {
            return Err(outside("slice", u64::from(slice), l.slices));
        }
        if right > u64::from(l.width) {
            return Err(outside("column", right.saturating_sub(1), l.width));
        }
        if bottom > u64::from(l.height) {
            return Err(outside("row", bottom.saturating_sub(1), l.height));
        }
        Ok(())
    }
}

/// Reads up to sixteen bytes as a little-endian integer.
pub(crate) fn read_le(bytes: &[u8]) -> u128 {
    let mut wide = [0; 16];
    wide[..bytes.len()].copy_from_slice(bytes);
    u128::from_le_bytes(wide)
}

fn check_extents(kind: TextureKind, width: u32, height: u32, depth: u32) -> Result<(), TextureError> {
    let range = 1..=MAX_TEXELS;
    let (fits, expected) = match kind {
        TextureKind::D1 => (height == 1 && depth == 1, "1 to 16384 x 1 x 1 texels"),
        TextureKind::D2 | TextureKind::Rectangle => (depth == 1, "1 to 16384 texels per side and depth 1"),
        TextureKind::Cube => (width == height && depth == 1, "square faces of 1 to 16384 texels per side and depth 1"),
        TextureKind::Volume => (true, "1 to 16384 texels per side"),
    };
    if fits && [width, height, depth].iter().all(|e| range.contains(e)) {
        return Ok(());
    }
    Err(TextureError::Extent { kind, expected, width, height, depth })
}
