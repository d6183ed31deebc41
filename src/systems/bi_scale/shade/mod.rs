//! Shading of pixels (section III, equation 3): the product of the bidirectional texture with the light that reaches a
//! pixel's local directions.
//!
//! - [`ShadedPixel`]: a pixel's vertices, texture coordinates and view; [`pixel_frame`]: its local frame;
//! - [`TextureLookup`]: a faster [`paper::radiance`](super::paper::radiance) with bit-identical results;
//! - [`TracedScene`]: ray-traced pixels, and the causes of a pixel's error.

mod pixel;
mod traced;

pub use pixel::{ShadedPixel, TextureLookup, pixel_frame};
pub use traced::{TracedLight, TracedPoint, TracedRung, TracedScene};
