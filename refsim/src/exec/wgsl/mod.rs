//! The executor for GPUs as text: WGSL modules that compute the reference's bits, in integers (every device gives the same)
//! or, where a device was found exact, single precision in its own floats. No GPU is needed to make or check the text.
//!
//! - `interface`: what the parts share. `kernel`: rasterisation, interpolation, tests, blending, targets.

/// Bindings, number formats and variables that all parts of a pixel module share.
pub const INTERFACE: &str = include_str!("interface.wgsl");
