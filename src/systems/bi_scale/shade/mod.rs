//! Shading of pixels (section III, equation 3): the product of the bidirectional texture with the light that reaches a
//! pixel's local directions.
//!
//! - [`ShadedPixel`]: a pixel's vertices, texture coordinates and view; [`pixel_frame`]: its local frame;
//! - [`TexelSamples`]: the four texels around texture coordinates;
//! - [`mod@reference`]: equation 3 by plain loops; [`TextureLookup`]: the same bits, faster;
//! - [`TracedScene`]: a pixel by rays, and the causes of its error.

mod lookup;
mod pixel;
pub mod reference;
mod traced;

pub use lookup::TextureLookup;
pub use pixel::{ShadedPixel, TexelSamples, pixel_frame};
pub use traced::{TracedLight, TracedPoint, TracedRung, TracedScene};
