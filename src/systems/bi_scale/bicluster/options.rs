//! Options and errors of biclustering.

use thiserror::Error;

/// Options of Algorithm 1 that the paper leaves open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BiclusterOptions {
    /// Random seed for the non-zeros at which biclusters start.
    pub seed: u64,
    /// True if rows and columns may also be deleted again (section IV-C: operations are insertions and deletions).
    pub deletion: bool,
    /// Residuals of at most this magnitude are dropped, once per matrix element; 0 is lossless, and so is what is
    /// negative or not a number. The sum of the biclusters then differs from the matrix by at most this in each element
    /// (the paper's future work, section VII).
    pub drop: f64,
}

impl Default for BiclusterOptions {
    fn default() -> Self {
        Self { seed: 1, deletion: true, drop: 0.0 }
    }
}

/// Reasons for which a matrix cannot be biclustered, or biclusters have no sum.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum BiclusterError {
    /// A sum that is no value of a matrix, which can happen for biclusters from elsewhere.
    #[error(
        "expected a sum that {holds} holds in row {row}, column {column} (counted from 0), found another: the \
         biclusters are of no matrix"
    )]
    Sum { row: u32, column: u32, holds: &'static str },
    /// More distinct residuals than 31 bits can name, or one beyond the range of f64.
    #[error("expected at most {} distinct residuals, all of them finite, found others", i32::MAX)]
    Residuals,
    /// More non-zeros than 32 bits can count.
    #[error("expected at most {} non-zeros, found {found}", u32::MAX)]
    TooMany { found: u64 },
}
