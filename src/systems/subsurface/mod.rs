//! System 3: light that scatters below a surface, gathered over a meshed atlas by fragment programs.
//!
//! docs/papers/subsurface.md maps each equation.
//!
//! - [`Coefficients`], [`Material`]: what the medium is made of, per mm;
//! - [`Dipole`]: the diffuse reflectance R_d of equation 7 by distance, its integrals over discs and the plane;
//! - [`fresnel`]: transmittance of the boundary and its means;
//! - [`irradiance`], [`distant_irradiance`]: equation 8 on the host;
//! - [`materials`]: the published media, each figure with its source;
//! - [`multipole`]: throughput factors, equation 10;
//! - [`links`]: which clusters a texel gathers from, and how textures hold them;
//! - [`kernels`], [`on_card`]: the three passes as programs of an emulated card;
//! - [`Reference`]: equation 9 over all pairs of texels;
//! - [`median_thickness`]: whether a model is thin for the dipole, which is made for a half space.

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
mod reference;
mod thickness;
mod triangles;

pub use dipole::Dipole;
#[doc(hidden)] // its bound is held against the exponential
pub use dipole_sum::exp_of_negative;
pub use fresnel::fresnel_transmittance;
pub use irradiance::{DistantSource, distant_irradiance, irradiance};
pub use material::{Coefficients, MAX_COEFFICIENT, MAX_ETA, MIN_SCATTERING, Material};
pub use reference::Reference;
pub use thickness::median_thickness;
