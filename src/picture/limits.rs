//! Limits on the size of pictures that are read.

use image::Limits;

use super::error::{MAX_DECODED_BYTES, MAX_SIDE, PictureError};

/// Limits for decoders of the `image` library.
pub fn limits() -> Limits {
    let mut limits = Limits::default();
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    limits.max_alloc = Some(MAX_DECODED_BYTES);
    limits
}

/// Rejects a size that would take too much memory.
pub(super) fn require_size(width: u64, height: u64, channels: usize, sample_bytes: u64) -> Result<(), PictureError> {
    let bytes = width.saturating_mul(height).saturating_mul(channels as u64).saturating_mul(sample_bytes);
    if width.max(height) > u64::from(MAX_SIDE) || bytes > MAX_DECODED_BYTES {
        return Err(PictureError::TooLarge { width, height, channels });
    }
    Ok(())
}
