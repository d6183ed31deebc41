//! Precomputed radiance transfer from a model to a file ([`Precomputation`]), how far compression is off
//! ([`CompressionError`]), and pictures ([`Rendering`]).

mod compression_error;
mod exit_radiance;
mod interpolate;
mod precompute;
mod render;

pub use compression_error::CompressionError;
pub(super) use exit_radiance::Lit;
pub(super) use interpolate::Seen;
pub use precompute::{ExitRadiance, Precomputation, PrecomputeError, Precomputed, Scatterer};
pub(super) use render::auto_exposure;
pub use render::{RenderError, Rendering};
