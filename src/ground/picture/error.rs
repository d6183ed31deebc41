//! Errors of pictures, and the formats and limits in their messages.

use crate::error::{InputError, ensure, input_error};

/// Maximum side of a picture that is read, in pixels.
pub(super) const MAX_SIDE: u32 = 16384;
/// Maximum memory of a decoded picture, in bytes (1 GiB).
pub(super) const MAX_DECODED_BYTES: u64 = 1 << 30;

/// File format of pictures.
#[derive(Clone, Copy, PartialEq, Eq, strum::Display)]
pub(super) enum PictureFormat {
    #[strum(to_string = "PNG")]
    Png,
    #[strum(to_string = "Radiance HDR")]
    Hdr,
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

/// Rejects a size that would take too much memory.
pub(super) fn require_size(width: u64, height: u64, channels: usize, sample_bytes: u64) -> Result<(), InputError> {
    let bytes = width.saturating_mul(height).saturating_mul(channels as u64).saturating_mul(sample_bytes);
    let fits = width.max(height) <= u64::from(MAX_SIDE) && bytes <= MAX_DECODED_BYTES;
    if fits { Ok(()) } else { Err(too_large(&format!("{width}x{height} with {channels} channels"))) }
}

/// The error of a picture beyond the limits.
pub(super) fn too_large(found: &str) -> InputError {
    input_error!("crossbar::picture::size" =>
        "expected a picture of at most {MAX_SIDE} pixels per side and {MAX_DECODED_BYTES} bytes decoded, found {found}")
}

/// Rejects a size for which a file is too short, because memory is allocated before the pixels are read. `least` is the
/// length of the shortest file of this size.
pub(super) fn require_length(
    format: PictureFormat,
    [width, height]: [u64; 2],
    least: u64,
    found: usize,
) -> Result<(), InputError> {
    ensure!(found as u64 >= least, "crossbar::picture::claim" =>
        "expected at least {least} bytes of a {format} file for the {width}x{height} pixels that its header says, found \
         {found}: is it truncated?");
    Ok(())
}
