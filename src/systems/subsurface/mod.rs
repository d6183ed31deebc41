//! System 3: subsurface scattering, gathered over a meshed atlas by fragment programs.
//!
//! - (9), (10): [`Reference`], all pairs of texels in plain f64 (`paper`; read it first);
//! - (7): [`Dipole`], the diffuse reflectance R_d by distance, and its integrals over discs and the plane;
//!   [`Coefficients`] per mm, [`Material`], and the published [`materials`];
//! - (6), (8): [`fresnel`], transmittance of the boundary; [`irradiance`], [`distant_irradiance`] on the host;
//! - 4.1: [`multipole`], throughput factors of (10); 4.2.1: [`links`], the clusters from which a texel gathers, and
//!   their textures;
//! - 4.2.2 to 4.2.4: [`kernels`], [`on_card`], the three passes as programs of an emulated card;
//! - [`median_thickness`]: shows whether a model is too thin for the dipole, which assumes a half space.
//!
//! docs/papers/subsurface.md says which file has which section.

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
#[doc(hidden)] // public for a test of its error bound
pub use dipole_sum::exp_of_negative;
pub use fresnel::fresnel_transmittance;
pub use irradiance::{DistantSource, distant_irradiance, irradiance};
pub use material::{Coefficients, MAX_COEFFICIENT, MAX_ETA, MIN_SCATTERING, Material};
pub use paper::Reference;
pub use thickness::median_thickness;
