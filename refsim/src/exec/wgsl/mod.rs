//! Generation of WGSL for the GPU executor: shader modules that compute the reference's bits in integer arithmetic, so
//! that every adapter gives the same result. Generation needs no GPU.
//!
//! - `interface`: declarations shared by all parts. [`kernel`] and [`target`]: rasterisation, tests, blending, targets.
//! - [`follow`]: kernel for pixel traces.
//! - [`number`]: arithmetic in every format of [`crate::num`]. [`texture`]: texture reads from a storage buffer.
//!   [`program`]: pixel programs and interpolation. [`parts`]: reduction of the text to the parts that a draw uses.
//!
//! Values have the "raw" representation of the batch executor: a fixed-point number is a sign-extended two's
//! complement integer; a float of any format is the binary32 pattern of the same number, and NaN is always
//! `0x7fc00000`.

pub mod follow;
pub mod kernel;
pub mod number;
pub mod parts;
pub mod program;
pub mod target;
pub mod texture;

/// Bindings, number formats and variables shared by all parts of a pixel module.
pub const INTERFACE: &str = include_str!("interface.wgsl");
