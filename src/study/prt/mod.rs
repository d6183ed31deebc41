//! Precomputed radiance transfer from a model to a file ([`Precomputation`]), how far compression is off
//! ([`CompressionError`]), pictures ([`Rendering`]), and pictures by an emulated card ([`OnCard`]).

mod card;
mod compression_error;
mod exit_radiance;
mod interpolate;
mod precompute;
mod render;

pub use card::{CardError, FactoredPrecision, OnCard, factored_precision, factored_precision_table};
pub use compression_error::CompressionError;
pub(super) use exit_radiance::Lit;
pub(super) use interpolate::{Seen, linear_picture};
pub use precompute::{ExitRadiance, Precomputation, PrecomputeError, Precomputed, Scatterer};
pub(super) use render::auto_exposure;
pub use render::{RenderError, Rendering, Turning};
