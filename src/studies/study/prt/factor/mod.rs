//! Factors of a reflectance: error by number of terms, compared with spherical harmonics; pictures; tables of G and F.

mod files;
mod harmonics;
mod report;
mod sphere;
mod subject;
mod sweep;
mod terms;

pub use subject::{BrdfFactors, FactorSubject};
pub(in crate::study) use sweep::{SweptRoughness, roughness_table};
