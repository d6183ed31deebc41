//! Decoding of picture files, whose first bytes determine the format.

use std::borrow::Cow;
use std::io::Cursor;

use image::codecs::hdr::HdrDecoder;
use image::{DynamicImage, ImageBuffer, ImageDecoder as _, ImageError, ImageFormat, ImageReader, Limits, Rgba};

use super::channels::{ChannelUnit, Picture, Samples};
use super::error::{MAX_DECODED_BYTES, MAX_SIDE, PictureFormat, decode_error, require_length, require_size, too_large};
use super::exr;
use crate::elementary::pow;
use crate::error::{InputError, input_error};

/// First bytes of Radiance HDR files, and of a variant that other programs write.
const RADIANCE: &[u8] = b"#?RADIANCE";
const RGBE: &[u8] = b"#?RGBE";
const SAMPLE_BYTES: u64 = 4;

fn format_of(bytes: &[u8]) -> Result<PictureFormat, InputError> {
    const SIGNATURES: [(&[u8], PictureFormat); 4] = [
        (b"\x89PNG\r\n\x1a\n", PictureFormat::Png),
        (RADIANCE, PictureFormat::Hdr),
        (RGBE, PictureFormat::Hdr),
        (b"\x76\x2f\x31\x01", PictureFormat::Exr),
    ];
    let known = SIGNATURES.iter().find(|(signature, _)| bytes.starts_with(signature));
    known.map(|(_, format)| *format).ok_or_else(|| {
        let hex: Vec<String> = bytes.iter().take(8).map(|byte| format!("{byte:02x}")).collect();
        let found = if hex.is_empty() { "nothing".to_owned() } else { hex.join(" ") };
        input_error!("crossbar::picture::format" =>
            "expected a PNG, Radiance HDR or OpenEXR picture, found a file that begins with {found}")
    })
}

impl Picture {
    /// Decodes a PNG, Radiance HDR or EXR file, detected by its first bytes. PNG gives `R`, `G`, `B` (and `A`, which is
    /// linear): sRGB values, or linear values if a gAMA or cICP chunk specifies the decoding. Radiance HDR gives linear
    /// values, divided by the factors of its EXPOSURE and COLORCORR lines. From an EXR file, the first layer is read;
    /// the picture has the size of the display window, with 0 outside the layer's pixels. A size beyond the limits, and
    /// more pixels than the file's bytes can encode, are refused before any pixel is decoded.
    pub fn decode(bytes: &[u8]) -> Result<Self, InputError> {
        match format_of(bytes)? {
            PictureFormat::Exr => {
                exr::check_size(bytes)?;
                exr::decode(bytes)
            }
            PictureFormat::Hdr => {
                let bytes = &with_known_header(bytes);
                check_size(bytes, PictureFormat::Hdr)?;
                let image = decoded(bytes, PictureFormat::Hdr)?.into_rgb32f();
                let scale = hdr_scale(bytes)?;
                let radiance = |pixel: [f32; 3]| [0, 1, 2].map(|channel| pixel[channel] / scale[channel]);
                let pixels: Vec<[f32; 3]> = image.pixels().map(|pixel| radiance(pixel.0)).collect();
                Ok(Self::rgb(image.width(), image.height(), &pixels))
            }
            PictureFormat::Png => {
                check_size(bytes, PictureFormat::Png)?;
                let exponent = png_exponent(bytes)?;
                from_png(&decoded(bytes, PictureFormat::Png)?, exponent)
            }
        }
    }
}

/// Decodes a PNG file to 16-bit codes: red, green, blue and alpha of each pixel, not converted to linear light.
pub fn png_codes(bytes: &[u8]) -> Result<ImageBuffer<Rgba<u16>, Vec<u16>>, InputError> {
    check_size(bytes, PictureFormat::Png)?;
    Ok(decoded(bytes, PictureFormat::Png)?.into_rgba16())
}

/// Rewrites a Radiance HDR file for the decoder: with a first line that the decoder accepts, and without header lines
/// that have white space around their variable's name. Radiance compares names from the first column up to `=` and so
/// ignores these lines, but the decoder would apply them.
fn with_known_header(bytes: &[u8]) -> Cow<'_, [u8]> {
    let spaced = |line: &[u8]| {
        let name = line.iter().position(|&byte| byte == b'=').map_or(&b""[..], |end| &line[..end]);
        name.trim_ascii().len() < name.len()
    };
    let end = bytes.windows(2).position(|pair| pair == b"\n\n").map_or(bytes.len(), |end| end + 1);
    let (header, pixels) = bytes.split_at(end);
    let rest = header.strip_prefix(RGBE).or_else(|| header.strip_prefix(RADIANCE)).unwrap_or(header);
    let lines = rest.split_inclusive(|&byte| byte == b'\n');
    let kept: Vec<&[u8]> = lines.filter(|line| !spaced(line)).collect();
    if header.starts_with(RADIANCE) && kept.concat().len() == rest.len() {
        return Cow::Borrowed(bytes);
    }
    Cow::Owned([RADIANCE, &kept.concat(), pixels].concat())
}

/// Factors by which radiance was multiplied, per channel, before it was written: the products of all EXPOSURE and
/// COLORCORR lines of a Radiance HDR file.
fn hdr_scale(bytes: &[u8]) -> Result<[f32; 3], InputError> {
    let refused = |reason: String| decode_error(PictureFormat::Hdr, reason);
    let header = HdrDecoder::new(Cursor::new(bytes)).map_err(|error| refused(error.to_string()))?.metadata();
    // Ward's tools write no GAMMA; other programs mark non-linear pixels with it, each by its own rule.
    let is_curve = |value: &str| value.trim().parse() != Ok(1.0);
    if let Some((_, found)) = header.custom_attributes.iter().find(|(key, value)| key == "GAMMA" && is_curve(value)) {
        let found: String = found.trim().chars().take(20).collect();
        return Err(refused(format!("expected linear pixels (GAMMA=1 or no such line), found GAMMA={found}")));
    }
    let (red, green, blue) = header.color_correction.unwrap_or((1.0, 1.0, 1.0));
    let scale = [red, green, blue].map(|correction| header.exposure.unwrap_or(1.0) * correction);
    match scale.into_iter().find(|factor| !(factor.is_finite() && *factor > 0.0)) {
        Some(found) => Err(refused(format!("expected EXPOSURE and COLORCORR of a positive product, found {found}"))),
        None => Ok(scale),
    }
}

fn refused(format: PictureFormat) -> impl Fn(ImageError) -> InputError {
    move |error| match error {
        ImageError::Limits(_) => too_large("more"),
        error => decode_error(format, error.to_string()),
    }
}

fn reader(bytes: &[u8], format: PictureFormat) -> ImageReader<Cursor<&[u8]>> {
    let decoder = if format == PictureFormat::Hdr { ImageFormat::Hdr } else { ImageFormat::Png };
    ImageReader::with_format(Cursor::new(bytes), decoder)
}

/// Checks the size of a PNG or HDR file: a decoder may work long before it fails, and does not report the size.
fn check_size(bytes: &[u8], format: PictureFormat) -> Result<(), InputError> {
    /// Maximum expansion of Deflate, in bytes per byte.
    const DEFLATE: u64 = 1032;
    /// Bytes of the shortest row of a Radiance HDR file: one repeated pixel.
    const HDR_ROW: u64 = 4;
    let header = reader(bytes, format).into_decoder().map_err(refused(format))?;
    let (columns, rows) = header.dimensions();
    let [columns, rows] = [columns, rows].map(u64::from);
    require_size(columns, rows, usize::from(header.color_type().channel_count()), SAMPLE_BYTES)?;
    let row_bits = columns * u64::from(header.original_color_type().bits_per_pixel());
    let least = if format == PictureFormat::Hdr { HDR_ROW * rows } else { rows * row_bits.div_ceil(8) / DEFLATE };
    require_length(format, [columns, rows], least, bytes.len())
}

fn decoded(bytes: &[u8], format: PictureFormat) -> Result<DynamicImage, InputError> {
    let (mut reader, mut limits) = (reader(bytes, format), Limits::default());
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    limits.max_alloc = Some(MAX_DECODED_BYTES);
    reader.limits(limits);
    reader.decode().map_err(refused(format))
}

/// Exponent by which samples of a PNG file become linear light; `None` for sRGB's curve, which is also the default.
/// cICP takes precedence over sRGB, and sRGB over gAMA. ICC profiles and chromaticities are ignored.
fn png_exponent(bytes: &[u8]) -> Result<Option<f64>, InputError> {
    let refused = |reason: String| decode_error(PictureFormat::Png, reason);
    let reader = ::png::Decoder::new(Cursor::new(bytes)).read_info().map_err(|error| refused(error.to_string()))?;
    let info = reader.info();
    let points = info.coding_independent_code_points;
    if points.is_some_and(|points| !points.is_video_full_range_image) {
        return Err(refused(
            "expected a cICP chunk of full range, found narrow range (video full range flag 0)".into(),
        ));
    }
    // Transfer characteristics of ITU-T H.273: 8 is linear, 13 is sRGB.
    match points.map(|points| points.transfer_function) {
        Some(8) => return Ok(Some(1.0)),
        Some(13) => return Ok(None),
        Some(found) => {
            return Err(refused(format!("expected a cICP chunk of transfer function 8 or 13, found {found}")));
        }
        None if info.srgb.is_some() => return Ok(None),
        None => {}
    }
    // The unit is 1 / 100,000. The reader skips a meaningless gAMA of 0.
    Ok(info.gama_chunk.map(|gamma| 1e5 / f64::from(gamma.into_scaled())))
}

/// Converts codes k of n bits to k / (2^n - 1), and raises colors to the power `exponent`, if there is one.
fn from_png(image: &DynamicImage, exponent: Option<f64>) -> Result<Picture, InputError> {
    // k / 255 is 257 k / 65535, to the bit.
    let (alpha, image) = (image.color().has_alpha(), image.to_rgba16());
    let color = if exponent.is_some() { ChannelUnit::Linear } else { ChannelUnit::Srgb };
    let names = [("R", color), ("G", color), ("B", color), ("A", ChannelUnit::Linear)];
    let mut named = names.into_iter().take(if alpha { 4 } else { 3 }).enumerate();
    named.try_fold(Picture::new(image.width(), image.height()), |picture, (channel, (name, unit))| {
        let sample = |code: u16| match exponent.filter(|_| channel < 3) {
            Some(exponent) => pow(f64::from(code) / 65535.0, exponent) as f32,
            None => f32::from(code) / 65535.0,
        };
        let samples = image.pixels().map(|pixel| sample(pixel.0[channel])).collect();
        picture.with(name, unit, Samples::Float(samples))
    })
}
