//! The meso-scale half: bidirectional textures, what a small patch of a surface sends out by place, view and light
//! (section III, equation 3).

mod response;

pub use response::{BidirectionalTexture, BidirectionalTextureError, ViewSamples};
