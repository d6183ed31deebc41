//! Limits on the size of pictures that are read.

use image::Limits;

use super::error::{MAX_DECODED_BYTES, MAX_SIDE, PictureFormat};
use crate::error::{InputError, input_error};

/// The size of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PictureSize {
    /// Pixels in a row, up to [`MAX_SIDE`].
    pub width: u32,
    /// Rows, up to [`MAX_SIDE`].
    pub height: u32,
    /// Samples per pixel.
    pub channels: usize,
}

impl PictureSize {
    /// Samples of all pixels.
    pub fn samples(self) -> u64 {
        u64::from(self.width) * u64::from(self.height) * self.channels as u64
    }
}

/// Limits for decoders of the `image` library.
pub(super) fn limits() -> Limits {
    let mut limits = Limits::default();
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    limits.max_alloc = Some(MAX_DECODED_BYTES);
    limits
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
    let found = found as u64;
    if found < least {
        Err(input_error!("crossbar::picture::claim" =>
            "expected at least {least} bytes of a {format} file for the {width}x{height} pixels that its header \
             says, found {found}: is it cut?"))
    } else {
        Ok(())
    }
}
