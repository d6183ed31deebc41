//! What may be chosen, and what may go wrong.

use thiserror::Error;

/// Choices of Algorithm 1 that the paper leaves open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BiclusterOptions {
    /// Of the non-zeros that biclusters start at.
    pub seed: u64,
    /// Whether rows and columns are also taken out again (section IV-C: operations are insertions and deletions).
    pub deletion: bool,
    /// Residuals of at most so many units are left out, once at each place: 0 loses nothing. The sum of the biclusters
    /// then differs from the matrix by no more than this, place by place (the paper's future work, section VII).
    pub drop: u32,
}

impl Default for BiclusterOptions {
    fn default() -> Self {
        Self { seed: 1, deletion: true, drop: 0 }
    }
}

/// Why a matrix cannot be biclustered.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum BiclusterError {
    /// A residual that leaves the range of 32 bits.
    #[error(
        "expected residuals within 32 bits, found {value} units in row {row}, column {column} (counted from 0): \
         give the matrix in fewer bits"
    )]
    Residual { row: u32, column: u32, value: i64 },
    /// More non-zeros than 32 bits can count in a line, after residuals were added.
    #[error("expected at most {} non-zeros, found {found}", u32::MAX)]
    TooMany { found: u64 },
}
