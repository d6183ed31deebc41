//! The executor for GPUs as text: WGSL modules that compute the reference's bits, in integers (every device gives the same)
//! or, where a device was found exact, single precision in its own floats. No GPU is needed to make or check the text.
//!
//! - [`accuracy`]: what WGSL allows a device's own floats.
//! - `interface`: what the parts share. [`kernel`] and [`target`]: rasterisation, interpolation, tests, blending, targets.
//! - [`follow`]: the kernel that tells everything about single pixels.
//! - [`number`]: arithmetic in every format of [`crate::num`]. [`texture`]: texture reads out of a storage buffer.
//!   [`program`]: pixel and vertex programs.
//!
//! Values are as the batch executor's slots hold them ("raw"): a fixed-point number is its two's complement integer,
//! sign-extended; a float of any format is the binary32 pattern of the same number, NaN always `0x7fc00000`.

pub mod accuracy;
pub mod follow;
pub mod kernel;
pub mod number;
pub mod program;
pub mod target;
pub mod texture;

pub use number::{NativeOperations, NumberMode};

/// Bindings, number formats and variables that all parts of a pixel module share.
pub const INTERFACE: &str = include_str!("interface.wgsl");
