//! Rendering (section 6 of the paper): products of light and the clusters' representatives, then a weighted sum per
//! vertex.
//!
//! - [`Shader`]: coded transfer laid out for rendering;
//! - [`TransferredRadiance`]: T_p of every vertex, equation 13;
//! - [`exit_radiance`]: G(v) . T_p, equation 7;
//! - [`plain`]: T_p by plain loops in f64.

pub mod plain;
mod shader;
mod transferred;

pub use shader::Shader;
use transferred::check_light;
pub use transferred::{Multiplies, TransferredRadiance, exit_radiance};
