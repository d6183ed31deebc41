//! Errors of factorization.

use thiserror::Error;

use crate::linalg::{FactorError, MatrixError};
use crate::transfer::brdf::BrdfError;

/// Errors of factorization.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Error, miette::Diagnostic)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum FactorizationError {
    /// A figure out of its range.
    #[error("expected {expected} for the {what}, found {found}")]
    #[diagnostic(code(crossbar::factor::range))]
    OutOfRange { what: &'static str, expected: &'static str, found: f64 },
    /// A figure of the reflectance out of its range.
    #[error(transparent)]
    #[diagnostic(code(crossbar::factor::brdf))]
    Brdf(#[from] BrdfError),
    /// A reflectance without a formula below the horizon.
    #[error("expected a reflectance with a formula below the horizon, found {what}")]
    #[diagnostic(code(crossbar::factor::continued), help("take 0 for texels outside the disc, or its rim"))]
    NotContinued { what: &'static str },
    /// A number of terms that is 0, or above the number of singular values distinguishable from 0.
    #[error("expected 1 to {rank} terms, the rank of the table, found {found}")]
    #[diagnostic(code(crossbar::factor::terms), help("ask for fewer terms"))]
    Terms { found: usize, rank: usize },
    /// A reflectance that reflects nothing.
    #[error("expected reflectance above 0 somewhere, found 0 in all {texels} texels of the table")]
    #[diagnostic(code(crossbar::factor::dark), help("a diffuse or specular part must be above 0"))]
    Dark { texels: usize },
    /// The singular values cannot be had.
    #[error(transparent)]
    #[diagnostic(code(crossbar::factor::svd))]
    Svd(#[from] FactorError),
}

impl From<MatrixError> for FactorizationError {
    fn from(error: MatrixError) -> Self {
        Self::Svd(error.into())
    }
}
