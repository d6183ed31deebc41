//! Throughput factors, equation 10: F_iC is 1 / A_i times the integral of R_d over a texel i and a cluster C.
//!
//! - [`SurfaceMoments`]: area, mean point and covariance of every cluster of an atlas;
//! - [`Factors`]: descends from a cluster until its pieces are small against their distance and the dipole's lengths,
//!   and takes the mean of R_d over each to second order; near texels are divided further.
//!
//! A factor is an area times a mean of R_d that is symmetric in texel and cluster, so A_i F_ij = A_j F_ji.

mod block;
mod clip;
mod error;
mod expansion;
mod face_map;
mod integrate;
mod kernel;
mod long;
mod moments;
mod near;
mod surface;

pub(super) use block::{BLOCK_LEVEL, BlockReceiver, TexelFactors};
pub use error::FactorError;
pub use integrate::{Factors, Receiver};
pub(super) use surface::to_morton;
pub use surface::{ClusterId, SurfaceMoments};

/// The least number of millimeters per unit of a model.
pub const MIN_MM_PER_UNIT: f64 = 1e-30;
/// The largest: squares and fourth powers of lengths keep far from the range of floats.
pub const MAX_MM_PER_UNIT: f64 = 1e30;

/// The default tolerance of a factor, relative.
pub const TOLERANCE: f64 = 0.01;
/// The least tolerance.
pub const MIN_TOLERANCE: f64 = 1e-5;
/// The largest tolerance.
pub const MAX_TOLERANCE: f64 = 0.1;
