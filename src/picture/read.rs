//! Decoding of picture files, by their first bytes.

use std::io::Cursor;

use image::codecs::hdr::HdrDecoder;
use image::{DynamicImage, ImageDecoder as _, ImageFormat, ImageReader};

use super::channels::{ChannelUnit, Picture, Samples};
use super::error::{PictureError, PictureFormat};
use super::exr;
use super::limits::{limits, require_size};

/// First bytes of Radiance HDR files, and the variant that other programs write.
const RADIANCE: &[u8] = b"#?RADIANCE";
const RGBE: &[u8] = b"#?RGBE";
/// Bytes per sample of a [`Picture`].
const SAMPLE_BYTES: u64 = 4;

/// Detects the format of a file by its first bytes.
fn format_of(bytes: &[u8]) -> Option<PictureFormat> {
    const SIGNATURES: [(&[u8], PictureFormat); 4] = [
        (b"\x89PNG\r\n\x1a\n", PictureFormat::Png),
        (RADIANCE, PictureFormat::Hdr),
        (RGBE, PictureFormat::Hdr),
        (b"\x76\x2f\x31\x01", PictureFormat::Exr),
    ];
    SIGNATURES.iter().find(|(signature, _)| bytes.starts_with(signature)).map(|(_, format)| *format)
}

impl Picture {
    /// Decodes a PNG, Radiance HDR or EXR file, detected by its first bytes. PNG gives sRGB values `R`, `G`, `B` (and
    /// `A`, which is linear), Radiance HDR linear ones, divided by the factors of its EXPOSURE and COLORCORR lines; of
    /// an EXR file the first layer is read.
    pub fn decode(bytes: &[u8]) -> Result<Self, PictureError> {
        match format_of(bytes) {
            Some(PictureFormat::Exr) => exr::decode(bytes),
            Some(PictureFormat::Png) => from_png(&decoded(bytes, PictureFormat::Png, ImageFormat::Png)?),
            Some(PictureFormat::Hdr) => {
                // The decoder accepts only one of the two first lines.
                let renamed = bytes.strip_prefix(RGBE).map(|rest| [RADIANCE, rest].concat());
                let bytes = renamed.as_deref().unwrap_or(bytes);
                let image = decoded(bytes, PictureFormat::Hdr, ImageFormat::Hdr)?.into_rgb32f();
                let scale = hdr_scale(bytes)?;
                let radiance = |pixel: [f32; 3]| [0, 1, 2].map(|channel| pixel[channel] / scale[channel]);
                let pixels: Vec<[f32; 3]> = image.pixels().map(|pixel| radiance(pixel.0)).collect();
                Ok(Self::rgb(image.width(), image.height(), &pixels))
            }
            None => {
                let hex: Vec<String> = bytes.iter().take(8).map(|byte| format!("{byte:02x}")).collect();
                let found = if hex.is_empty() { "nothing".to_owned() } else { hex.join(" ") };
                Err(PictureError::Unrecognized { found })
            }
        }
    }
}

/// Factors by which radiance was multiplied, per channel, before it was written: the products of all EXPOSURE and
/// COLORCORR lines of a Radiance HDR file.
fn hdr_scale(bytes: &[u8]) -> Result<[f32; 3], PictureError> {
    let refused = |reason: String| PictureError::Decode { format: PictureFormat::Hdr, reason };
    let header = HdrDecoder::new(Cursor::new(bytes)).map_err(|error| refused(error.to_string()))?.metadata();
    let (red, green, blue) = header.color_correction.unwrap_or((1.0, 1.0, 1.0));
    let scale = [red, green, blue].map(|correction| header.exposure.unwrap_or(1.0) * correction);
    match scale.into_iter().find(|factor| !(factor.is_finite() && *factor > 0.0)) {
        Some(found) => Err(refused(format!("expected EXPOSURE and COLORCORR of a positive product, found {found}"))),
        None => Ok(scale),
    }
}

fn decoded(bytes: &[u8], format: PictureFormat, decoder: ImageFormat) -> Result<DynamicImage, PictureError> {
    let refused = |error: image::ImageError| PictureError::Decode { format, reason: error.to_string() };
    // The header is checked first: a decoder may work long before it fails, and does not report the size.
    let header = ImageReader::with_format(Cursor::new(bytes), decoder).into_decoder().map_err(refused)?;
    let ((width, height), color) = (header.dimensions(), header.color_type());
    require_size(width.into(), height.into(), color.channel_count().into(), SAMPLE_BYTES)?;
    let mut reader = ImageReader::with_format(Cursor::new(bytes), decoder);
    reader.limits(limits());
    reader.decode().map_err(refused)
}

/// Converts codes k of n bits to k / (2^n - 1).
fn from_png(image: &DynamicImage) -> Result<Picture, PictureError> {
    // k / 255 is 257 k / 65535, to the bit.
    let (alpha, image) = (image.color().has_alpha(), image.to_rgba16());
    let names =
        [("R", ChannelUnit::Srgb), ("G", ChannelUnit::Srgb), ("B", ChannelUnit::Srgb), ("A", ChannelUnit::Linear)];
    let mut named = names.into_iter().take(if alpha { 4 } else { 3 }).enumerate();
    named.try_fold(Picture::new(image.width(), image.height()), |picture, (channel, (name, unit))| {
        let samples = image.pixels().map(|pixel| f32::from(pixel.0[channel]) / 65535.0).collect();
        picture.with(name, unit, Samples::Float(samples))
    })
}
