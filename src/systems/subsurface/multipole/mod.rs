//! A multipole method for the throughput factors of equation 10 (section 4.1): F_iC is 1 / A_i times the integral of
//! R_d over a texel i and a cluster C. The paper does not describe its integration; the method is ours.
//!
//! - Moments: [`SurfaceMoments`] has area, mean point and covariance of every cluster of an atlas. For a far cluster,
//!   the mean of R_d is computed to second order from the moments of texel and cluster (`kernel`).
//! - Descent: [`Factors`] descends from a cluster to its children until they are far from a texel (`integrate`).
//! - Local expansions: squares of texels gather from far clusters together (`block`, `expansion`).
//! - Near texels are divided into quarters (`near`); texels that are long relative to the mean free path are integrated
//!   by contours (`long`).
//!
//! A factor is an area times a mean of R_d that is symmetric in texel and cluster, so A_i F_ij = A_j F_ji.

mod block;
mod expansion;
mod face_map;
mod integrate;
mod kernel;
mod long;
mod moments;
mod near;
mod surface;

use crate::error::{InputError, ensure};

pub(super) use block::{BLOCK_LEVEL, BlockReceiver, TexelFactors};
pub use integrate::{Factors, Receiver};
pub use surface::{ClusterId, SurfaceMoments};
pub(super) use surface::{from_morton, to_morton};

/// The least number of millimeters per unit of a model.
pub const MIN_MM_PER_UNIT: f64 = 1e-30;
/// The largest number of millimeters per unit: fourth powers of lengths stay well inside the range of floats.
pub const MAX_MM_PER_UNIT: f64 = 1e30;

/// Checks that the scale of a model is within its limits.
pub(super) fn check_scale(mm_per_unit: f64) -> Result<(), InputError> {
    ensure!((MIN_MM_PER_UNIT..=MAX_MM_PER_UNIT).contains(&mm_per_unit), "subsurface::links" =>
        "expected {MIN_MM_PER_UNIT:e} to {MAX_MM_PER_UNIT:e} millimeters per unit of the model, found {mm_per_unit:e}");
    Ok(())
}

pub(super) fn check_values(found: usize, texels: usize) -> Result<(), InputError> {
    ensure!(found == texels, "subsurface::links" => "expected a value for each of {texels} texels, found {found}");
    Ok(())
}

/// The default relative tolerance of a factor.
pub const TOLERANCE: f64 = 0.01;
/// The least tolerance.
pub const MIN_TOLERANCE: f64 = 1e-5;
/// The largest tolerance.
pub const MAX_TOLERANCE: f64 = 0.1;
