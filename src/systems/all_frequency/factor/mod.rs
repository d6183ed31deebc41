//! Factors of reflectance (section 3): f(v, s) = b(v, s) s_z as a sum of products G_k(v) F_k(s).
//!
//! - [`ProductFunction`]: f of a reflectance: a [`Lobe`], with options that the paper leaves open, or a [`Brdf`] of
//!   `transfer::brdf`;
//! - [`FactorSampling`]: samples f on parabolic maps, a [`ProductTable`]; choices that the paper leaves open are named
//!   options;
//! - [`Factorization`]: the table's singular values, and [`ProductFactors`] of any number of terms, interpolated
//!   between texels;
//! - [`ProductErrors`], [`harmonic_errors`]: errors of approximations by terms and by spherical harmonics, at texels
//!   ([`DiscSamples`]) or at directions with equal solid angles ([`HemisphereSamples`]).
//!
//! Directions are local: z is the normal, x the tangent.

mod disc;
mod factors;
mod lobe;
mod product;
mod sampling;
mod table;

pub use disc::{DiscSamples, HemisphereSamples, ProductErrors, harmonic_errors};
pub use factors::{Factorization, PAIR_DISTANCE, ProductFactors, SplitPair};
pub use lobe::{Denominators, FacetDistribution, FresnelForm, Lobe, Shadowing, TangentCosine};
pub use product::{ProductFunction, ProductSymmetry};
pub use sampling::{FactorSampling, MAX_SUPERSAMPLES, Supersamples};
pub use table::{MAX_MAP_SIDE, ProductTable, load_product_table};

#[cfg(doc)]
use crate::transfer::brdf::Brdf;
