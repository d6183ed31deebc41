//! Factors of a reflectance: error by number of terms, compared with spherical harmonics; pictures; tables of G and F.

mod report;
mod sphere;
mod subject;
mod tables;

pub use subject::{BrdfFactors, FactorSubject};
pub(in crate::study) use subject::{SweptRoughness, roughness_table};
