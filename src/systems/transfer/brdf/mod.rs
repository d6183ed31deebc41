//! Reflectance in local coordinates, and its matrices over spherical harmonics (section 3.1).
//!
//! - [`Brdf`]: Lambert, Phong, Cook-Torrance, Schlick, Ward, Ashikhmin-Shirley, one channel each;
//! - [`ExitBasis`], [`brdf_matrix`]: the matrix B, and its least-squares forms.

pub(crate) mod facets;
mod matrix;
mod models;

pub use matrix::{BRDF_DEGREE, ExitBasis, brdf_matrix};
pub(crate) use matrix::{Projector, exit_per_direction, integrals};
pub use models::Brdf;
