//! The executor for GPUs as text: WGSL modules that compute the reference's bits, in integers, so that every adapter
//! gives the same. No GPU is needed to make or check the text.
//!
//! - `interface`: what the parts share. [`kernel`] and [`target`]: rasterisation, tests, blending, targets.
//! - [`follow`]: the kernel that tells everything about single pixels.
//! - [`number`]: arithmetic in every format of [`crate::num`]. [`texture`]: texture reads out of a storage buffer.
//!   [`program`]: pixel programs and interpolation. [`parts`]: the text with the parts that a draw uses.
//! - [`accuracy`]: what WGSL allows an adapter's own floats.
//!
//! Values are as the batch executor's slots hold them ("raw"): a fixed-point number is its two's complement integer,
//! sign-extended; a float of any format is the binary32 pattern of the same number, NaN always `0x7fc00000`.

pub mod accuracy;
pub mod follow;
pub mod kernel;
pub mod number;
pub mod parts;
pub mod program;
pub mod target;
pub mod texture;

/// Bindings, number formats and variables that all parts of a pixel module share.
pub const INTERFACE: &str = include_str!("interface.wgsl");
