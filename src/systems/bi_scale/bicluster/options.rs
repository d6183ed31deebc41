//! Options and errors of biclustering.

use thiserror::Error;

/// Options of Algorithm 1 that the paper leaves open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BiclusterOptions {
    /// Random seed for the non-zeros at which biclusters start.
    pub seed: u64,
    /// True if rows and columns may also be deleted again (section IV-C: operations are insertions and deletions).
    pub deletion: bool,
    /// Residuals of at most this many units are dropped, once per matrix element; 0 is lossless. The sum of the
    /// biclusters then differs from the matrix by at most this in each element (the paper's future work, section VII).
    pub drop: u32,
}

impl Default for BiclusterOptions {
    fn default() -> Self {
        Self { seed: 1, deletion: true, drop: 0 }
    }
}

/// Reasons for which a matrix cannot be biclustered.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum BiclusterError {
    /// A residual that does not fit 32 bits.
    #[error(
        "expected residuals within 32 bits, found {value} units in row {row}, column {column} (counted from 0): \
         give the matrix in fewer bits"
    )]
    Residual { row: u32, column: u32, value: i64 },
    /// More non-zeros than 32 bits can count.
    #[error("expected at most {} non-zeros, found {found}", u32::MAX)]
    TooMany { found: u64 },
}
