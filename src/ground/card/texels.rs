//! Rectangles of floats on the host, and their transfer to and from textures of a card.

use refsim::device::Profile;
use refsim::machine::{Machine, MachineError, TextureId};
use refsim::num::Format;
use refsim::texture::{Image, SignedTexelMinimum, TargetRounding, TexelFormat, TextureError, TextureKind};

use crate::picture::Picture;

/// Texels of four f32, row by row. A vector is one row: a 1-D texture.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Texels {
    /// Texels per row.
    pub width: usize,
    /// Number of rows.
    pub height: usize,
    /// Red, green, blue and alpha of `width * height` texels.
    pub texels: Vec<[f32; 4]>,
}

impl Texels {
    /// Texels computed by a function of column and row.
    pub fn from_fn([width, height]: [usize; 2], texel: impl Fn(usize, usize) -> [f32; 4]) -> Self {
        let texels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| texel(x, y)).collect();
        Self { width, height, texels }
    }

    /// A single row.
    pub fn vector(texels: Vec<[f32; 4]>) -> Self {
        Self { width: texels.len(), height: 1, texels }
    }

    /// A row of texels. Panics if there is no such row.
    pub fn row(&self, y: usize) -> &[[f32; 4]] {
        &self.texels[y * self.width..(y + 1) * self.width]
    }

    /// Red, green and blue of each texel, row by row.
    pub fn colors(&self) -> Vec<[f64; 3]> {
        self.texels.iter().map(|&[red, green, blue, _]| [red, green, blue].map(f64::from)).collect()
    }

    /// Red, green and blue as a picture of linear light.
    pub fn picture(&self) -> Picture {
        let pixels: Vec<[f32; 3]> = self.texels.iter().map(|&[red, green, blue, _]| [red, green, blue]).collect();
        Picture::rgb(self.width as u32, self.height as u32, &pixels)
    }

    fn to_image(&self, format: TexelFormat) -> Result<Image, TextureError> {
        let extents = extents([self.width, self.height]);
        if format == TexelFormat::Rgba32f {
            // Fast path for large matrices: f32 bits are stored unchanged.
            let bytes = self.texels.as_flattened().iter().flat_map(|value| value.to_le_bytes()).collect();
            return Image::from_bytes(format, TextureKind::Rectangle, extents, 1, bytes);
        }
        let bits: Vec<[u32; 4]> = self.texels.iter().map(|texel| texel.map(f32::to_bits)).collect();
        Image::from_values(format, TextureKind::Rectangle, extents, Format::FP32, &bits, TargetRounding::Nearest)
    }

    /// The texels of an image with one level; components missing from the format have the values that the card reads.
    fn from_image(image: &Image) -> Self {
        let [width, height] = [image.width(), image.height()].map(|side| side as usize);
        let value = |bytes: &[u8]| f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
        match image.format() {
            TexelFormat::Rgba32f => {
                let texel = |bytes: &[u8]| [0, 4, 8, 12].map(|at| value(&bytes[at..at + 4]));
                Self { width, height, texels: image.bytes().chunks_exact(16).map(texel).collect() }
            }
            TexelFormat::R32f => {
                let texel = |bytes: &[u8]| [value(bytes), 1.0, 1.0, 1.0];
                Self { width, height, texels: image.bytes().chunks_exact(4).map(texel).collect() }
            }
            _ => Self::level_of(image, 0, [width, height]),
        }
    }

    fn level_of(image: &Image, level: u32, size: [usize; 2]) -> Self {
        Self::from_fn(size, |x, y| {
            let texel = image.texel(level, 0, y as u32, x as u32, SignedTexelMinimum::Clamp);
            texel.to_format(Format::FP32).map(f32::from_bits)
        })
    }

    /// The texels of all levels of an image, finest first.
    pub fn levels_of(image: &Image) -> Vec<Self> {
        let levels = (0..).zip(image.levels());
        levels.map(|(level, size)| Self::level_of(image, level, [size.width as usize, size.height as usize])).collect()
    }

    /// A new texture on a card with these texels.
    pub fn upload(&self, machine: &mut Machine, format: TexelFormat) -> Result<TextureId, MachineError> {
        machine.create_texture(self.to_image(format)?)
    }

    /// Replaces the contents of a texture. Fails with [`MachineError`] if the texture has another size or format.
    pub fn update(&self, machine: &mut Machine, texture: TextureId, format: TexelFormat) -> Result<(), MachineError> {
        machine.update_texture(texture, &self.to_image(format)?)
    }

    /// Reads back the contents of a target, for which the host waits.
    pub fn read_back(machine: &Machine, target: TextureId) -> Result<Self, MachineError> {
        Ok(Self::from_image(machine.read_back(target)?))
    }
}

/// A target filled with zeros that can be read as a texture.
pub fn new_target(machine: &mut Machine, format: TexelFormat, size: [usize; 2]) -> Result<TextureId, MachineError> {
    machine.create_target_from(Image::new(format, TextureKind::Rectangle, extents(size), 1)?)
}

/// A texture from texels in order, each number rounded once into the format.
pub fn new_texture(
    machine: &mut Machine,
    format: TexelFormat,
    kind: TextureKind,
    extents: [u32; 3],
    texels: impl IntoIterator<Item = [f32; 4]>,
) -> Result<TextureId, MachineError> {
    let bits: Vec<[u32; 4]> = texels.into_iter().map(|texel| texel.map(f32::to_bits)).collect();
    machine.create_texture(Image::from_values(format, kind, extents, Format::FP32, &bits, TargetRounding::Nearest)?)
}

/// Extents for an image; sizes beyond 32 bits become u32::MAX, which the image rejects.
fn extents([width, height]: [usize; 2]) -> [u32; 3] {
    let extent = |size| u32::try_from(size).unwrap_or(u32::MAX);
    [extent(width), extent(height), 1]
}

/// The format of a device's maps of signed fractions: the first of `formats` that it has, otherwise signed 8 bits.
pub fn signed_format(profile: &Profile, formats: &[TexelFormat]) -> TexelFormat {
    let has = |format: &&TexelFormat| profile.limits.texture_formats.contains(*format);
    formats.iter().find(has).copied().unwrap_or(TexelFormat::Rgba8Snorm)
}
