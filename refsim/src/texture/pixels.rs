//! Pixels of an image for display: red, green, blue and alpha by column and row.

use super::{ChannelValue, Image, SignedTexelMinimum, Texel, decode};
use crate::num;

impl ChannelValue {
    /// Converts the value to f64, rounded once, for display; NaN and infinities are preserved.
    pub fn to_f64(self) -> f64 {
        match self {
            Self::Ratio { numerator, denominator } => numerator as f64 / f64::from(denominator),
            Self::Float { format, bits } => num::to_f64(&format, bits),
        }
    }
}

impl Texel {
    /// Red, green, blue and alpha as f64.
    pub fn to_f64(self) -> [f64; 4] {
        self.0.map(ChannelValue::to_f64)
    }
}

/// A pixel of level 0 and slice 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImagePixel {
    /// Column.
    pub x: u32,
    /// Row.
    pub y: u32,
    /// Red, green, blue and alpha.
    pub rgba: [f64; 4],
}

impl Image {
    /// Red, green, blue and alpha of the pixel in column `x` of row `y`, level 0, slice 0; components that the format
    /// does not store have their defaults. The smallest code of a signed channel gives a value below -1. `None` outside
    /// the image.
    ///
    /// ```
    /// use refsim::texture::{Image, TexelFormat};
    ///
    /// # fn main() -> Result<(), refsim::texture::TextureError> {
    /// let mut image = Image::new_2d(TexelFormat::Bgra8, 2, 1)?;
    /// image.set_raw(0, 0, 0, 1, 0xff00_33ff); // level, slice, row, column; A8R8G8B8
    /// assert_eq!(image.pixel(1, 0), Some([0.0, 0.2, 1.0, 1.0]));
    /// assert_eq!(image.pixel(2, 0), None);
    /// let opaque = image.pixels().filter(|pixel| pixel.rgba[3] == 1.0).count();
    /// assert_eq!(opaque, 1);
    /// # Ok(())
    /// # }
    /// ```
    pub fn pixel(&self, x: u32, y: u32) -> Option<[f64; 4]> {
        self.offset_of(0, 0, y, x)?;
        Some(decode(self.format(), self.raw(0, 0, y, x), SignedTexelMinimum::BelowMinusOne).to_f64())
    }

    /// All pixels of level 0 and slice 0, row by row.
    pub fn pixels(&self) -> impl Iterator<Item = ImagePixel> + '_ {
        let places = (0..self.height()).flat_map(|y| (0..self.width()).map(move |x| (x, y)));
        places.filter_map(|(x, y)| Some(ImagePixel { x, y, rgba: self.pixel(x, y)? }))
    }

    /// Encodes level 0, slice 0 as a PNG file with 8 bits per channel: values below 0 and NaN become 0, values above 1
    /// become 255, and other values the nearest code. No transfer function is applied. Needs the feature `png`.
    ///
    /// ```
    /// use refsim::texture::{Image, TexelFormat};
    ///
    /// let image = Image::new_2d(TexelFormat::Bgra8, 4, 4).expect("sixteen texels");
    /// assert!(image.to_png().starts_with(b"\x89PNG"));
    /// ```
    #[cfg(feature = "png")]
    pub fn to_png(&self) -> Vec<u8> {
        let code = |value: f64| (value.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
        let bytes: Vec<u8> = self.pixels().flat_map(|pixel| pixel.rgba.map(code)).collect();
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, self.width(), self.height());
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        let written = encoder.write_header().and_then(|mut writer| writer.write_image_data(&bytes));
        written.expect("an image has at least one texel, and memory holds its four bytes a texel");
        file
    }
}
