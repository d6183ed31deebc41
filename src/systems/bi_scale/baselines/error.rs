//! Errors of storing transfer.

use thiserror::Error;

use crate::transfer::clustering::CpcaError;
use crate::transfer::grid::LIGHT_TEXELS;

/// Errors of storing transfer. Rows and columns count from 0.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum BaselineError {
    /// A matrix whose columns are not the light texels.
    #[error("expected a matrix of {LIGHT_TEXELS} columns, a light texel each, found {found}")]
    Columns { found: usize },
    /// Rows that are not those of the vertices.
    #[error("expected {expected} rows, one per vertex and local direction, found {found}: name the model of the file")]
    Rows { expected: usize, found: usize },
    /// A column that a layout's numbers do not reach.
    #[error("expected columns of at most {most} in this layout, found {column}: take one of wider numbers")]
    ColumnRange { column: u32, most: u32 },
    /// A value that a layout's numbers do not hold.
    #[error("expected {holds} in this layout, found {value:e} in row {row}: take one of wider numbers")]
    ValueRange { row: usize, value: f64, holds: &'static str },
    /// Rows without coefficients.
    #[error("expected 1 to {LIGHT_TEXELS} coefficients per row, found {found}")]
    Coefficients { found: usize },
    /// A matrix of zeros, which has no principal components.
    #[error("expected a row with a value other than 0, found none")]
    Dark,
    /// No row to find clusters from.
    #[error("expected at least {clusters} rows to find {clusters} clusters from, found {found}")]
    Sample { clusters: usize, found: usize },
    /// Clusters that cannot be found.
    #[error(transparent)]
    Clusters(#[from] CpcaError),
    /// An order of harmonics.
    #[error("expected an order of harmonics of 1 to {most}, found {found}", most = crate::sphere::MAX_ORDER)]
    Order { found: usize },
    /// Texels of a coarse cube.
    #[error("expected 1, 2, 4, 8, 16 or 32 texels along an edge of the coarse cube, found {found}")]
    CoarseSide { found: usize },
}
