//! Errors of pictures, and the formats and limits in their messages.

use crate::error::{InputError, input_error};

/// Maximum side of a picture that is read, in pixels.
pub const MAX_SIDE: u32 = 16384;
/// Maximum memory of a decoded picture, in bytes (1 GiB).
pub const MAX_DECODED_BYTES: u64 = 1 << 30;

/// File format of pictures.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::Display)]
pub enum PictureFormat {
    /// Portable Network Graphics: sRGB values of 8 or 16 bits.
    #[strum(to_string = "PNG")]
    Png,
    /// Radiance's RGBE: linear light with a shared exponent.
    #[strum(to_string = "Radiance HDR")]
    Hdr,
    /// OpenEXR: named channels of half floats, single floats and integers.
    #[strum(to_string = "EXR")]
    Exr,
}

pub(super) fn samples_error(width: u32, height: u32, expected: u64, found: u64) -> InputError {
    input_error!("crossbar::picture::samples" =>
        "expected {expected} samples for a picture of {width}x{height}, found {found}")
}

pub(super) fn encode_error(format: PictureFormat, reason: String) -> InputError {
    input_error!("crossbar::picture::encode" => "the {format} file cannot be encoded: {reason}")
}

pub(super) fn decode_error(format: PictureFormat, reason: String) -> InputError {
    input_error!("crossbar::picture::decode" => "the {format} data cannot be read: {reason}")
}

/// Code of the error of a picture without color channels.
pub const NO_COLOR: &str = "crossbar::picture::color";

pub(super) fn no_color_error(found: &str) -> InputError {
    input_error!("crossbar::picture::color" =>
        "expected channels R, G and B, or Y; found {}", if found.is_empty() { "none" } else { found })
}
