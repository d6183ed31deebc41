//! Errors of the baselines.

use thiserror::Error;

/// Errors of computing a frame.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum BaselineError {
    /// A number of values per point that makes no matrix with this many rows.
    #[error("expected {rows} rows of 1, 4, 9, ... or 100 numbers per point, found {found} numbers per point")]
    Shape { rows: usize, found: usize },
    /// Light of another order than the matrices.
    #[error("expected light of {expected} functions, one per column of a matrix, found {found}")]
    Light { expected: usize, found: usize },
    /// A matrix whose rows are not those of the exit basis.
    #[error("expected a matrix of {expected} rows, one per function of exit radiance, found {found}")]
    BrdfRows { expected: usize, found: usize },
    /// Maps of other functions than a vertex has coefficients.
    #[error("expected {expected} coefficients per vertex, one per map, found {found}")]
    Coefficients { expected: usize, found: usize },
    /// Coefficients of other vertices.
    #[error("expected coefficients of {expected} vertices, found those of {found}")]
    Vertices { expected: usize, found: usize },
}
