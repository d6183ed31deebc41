//! Pictures as numbers and as files: named channels of samples, read from and written to OpenEXR, Radiance HDR and PNG.
//!
//! A [`Picture`] holds measured or read values in single precision. An [`RgbImage`] is for display: 8 bits per channel,
//! encoded from linear light by the sRGB curve of [`display`]. All functions work on bytes in memory; `io::picture`
//! reads files.

mod channels;
pub mod display;
mod error;
mod exr;
mod hdr;
pub mod metrics;
mod notes;
mod png;
mod read;

pub use self::channels::{ChannelUnit, Picture, PictureChannel, Samples};
pub use self::error::NO_COLOR;
pub use self::exr::{exr, exr_with_notes};
pub use self::hdr::hdr;
pub use self::notes::PictureNotes;
pub use self::png::{buffer, png, png_with_notes, rgb8};
pub use self::read::png_codes;
pub use image::{ImageBuffer, Rgb, RgbImage, Rgba};
