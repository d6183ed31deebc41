//! Rendering (section 6 of the paper): light through the clusters' representatives, then a weighted sum per vertex.
//!
//! - [`Shader`]: coded transfer laid out for that;
//! - [`TransferredRadiance`]: T_p of every vertex, equation 13;
//! - [`exit_radiance`]: G(v) . T_p, equation 7;
//! - [`plain`]: the same from transfer that is not coded, by plain loops in f64.

pub mod plain;
mod shader;
mod transferred;

pub use shader::Shader;
pub use transferred::{LightSizeError, Multiplies, TransferredRadiance, exit_radiance};
