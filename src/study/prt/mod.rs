//! Precomputed radiance transfer from a model to a file ([`Precomputation`]), and how far compression is off
//! ([`CompressionError`]).

mod compression_error;
mod precompute;

pub use compression_error::CompressionError;
pub use precompute::{ExitRadiance, Precomputation, PrecomputeError, Precomputed, Scatterer};
