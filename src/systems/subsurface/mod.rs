//! System 3: light that scatters below a surface, gathered over a meshed atlas by fragment programs.
//!
//! - (9), (10): [`Reference`], all pairs of texels in plain f64 (`paper`, to be read first);
//! - (7): [`Dipole`], the diffuse reflectance R_d by distance, its integrals over discs and the plane; [`Coefficients`],
//!   [`Material`], per mm, and the published [`materials`];
//! - (6), (8): [`fresnel`], transmittance of the boundary; [`irradiance`], [`distant_irradiance`] on the host;
//! - 4.1: [`multipole`], throughput factors of (10); 4.2.1: [`links`], which clusters a texel gathers from, and how
//!   textures hold them;
//! - 4.2.2 to 4.2.4: [`kernels`], [`on_card`], the three passes as programs of an emulated card;
//! - [`median_thickness`]: whether a model is thin for the dipole, which is made for a half space.
//!
//! docs/papers/subsurface.md maps each equation.

mod dipole;
mod dipole_sum;
pub mod fresnel;
mod irradiance;
pub mod kernels;
pub mod links;
mod material;
pub mod materials;
pub mod multipole;
pub mod on_card;
mod paper;
mod thickness;
mod triangles;

pub use dipole::Dipole;
#[doc(hidden)] // its bound is held against the exponential
pub use dipole_sum::exp_of_negative;
pub use fresnel::fresnel_transmittance;
pub use irradiance::{DistantSource, distant_irradiance, irradiance};
pub use material::{Coefficients, MAX_COEFFICIENT, MAX_ETA, MIN_SCATTERING, Material};
pub use paper::Reference;
pub use thickness::median_thickness;
