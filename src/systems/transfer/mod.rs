//! Modules that the three systems of precomputed radiance transfer share: clustered PCA (system 4, [`cpca`]),
//! all-frequency transfer (system 5, [`all_frequency`]) and bi-scale transfer (system 6, [`bi_scale`]).
//!
//! [`cpca`]: crate::cpca
//! [`all_frequency`]: crate::all_frequency
//! [`bi_scale`]: crate::bi_scale
//!
//! - [`Vertices`]: unique positions, normals and tangents of a mesh, with a [`LocalFrame`] each;
//! - [`brdf`]: reflectance functions, and their matrices of harmonics;
//! - [`grid`], [`haar`], [`linear_basis`]: the cube of light texels, its segments and their bases;
//! - [`light`]: light as coefficients over the cube; [`visibility`]: the directions that each vertex sees;
//! - [`mod@file`]: files of transfer (`.npz`); [`load_signal`] reads a signal from such a file, or from NPY or CSV;
//! - [`synthetic`]: signals given by formulas, for tests and measurements.

pub mod brdf;
pub(crate) mod error;
pub mod file;
mod frame;
pub mod grid;
pub mod haar;
pub mod light;
pub mod linear_basis;
mod load;
mod plain;
mod shooter;
mod skyline;
pub mod synthetic;
mod vertices;
pub mod visibility;

pub use frame::LocalFrame;
pub use load::load_signal;
pub(crate) use plain::{plain_hit, plain_origin};
pub use shooter::ray_length;
pub(crate) use shooter::{FrontHit, RayOrigin, Shooter, VertexRays, origins};
pub(crate) use skyline::{Occluders, SkyPart, ones};
pub use vertices::{Tangents, Vertices};
