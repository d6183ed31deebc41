//! The common interface of stored transfer, and the error of its local light.

use crate::bi_scale::bicluster::Biclustering;
use crate::bi_scale::paper;
use crate::error::{InputError, input_error};
use crate::transfer::grid::LIGHT_TEXELS;

/// Transfer stored by one of the compression methods.
pub trait StoredTransfer {
    /// Size in bytes of each layout. [`Self::multiply`] computes with the numbers of the first layout.
    fn sizes(&self) -> Vec<StoredSize>;

    /// Local light L~ in f64, one number per row of T. Panics if `light` does not have one number per column of T.
    fn multiply(&self, light: &[f64]) -> Vec<f64>;
}

/// Size of a layout.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StoredSize {
    /// A short name of the layout.
    pub layout: &'static str,
    /// Bytes of everything that depends on the transfer.
    pub bytes: u64,
}

/// Error of local light against T L, over all rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocalLightError {
    /// Root mean square of the differences, in the unit of the light.
    pub root_mean_square: f64,
    /// The largest difference, in the unit of the light.
    pub largest: f64,
    /// `root_mean_square` relative to the root mean square of T L; 0 if there is no difference.
    pub relative: f64,
}

impl LocalLightError {
    /// The error of found light against expected light, row by row. Panics if the numbers of rows differ, or are 0.
    pub fn new(found: &[f64], expected: &[f64]) -> Self {
        assert!(!expected.is_empty() && found.len() == expected.len(), "a number per row");
        let (mut squares, mut whole, mut largest) = (0.0, 0.0, 0.0_f64);
        for (found, expected) in found.iter().zip(expected) {
            let difference = found - expected;
            squares += difference * difference;
            whole += expected * expected;
            largest = largest.max(difference.abs());
        }
        let relative = if squares > 0.0 { (squares / whole).sqrt() } else { 0.0 };
        Self { root_mean_square: (squares / expected.len() as f64).sqrt(), largest, relative }
    }
}

/// Bytes of a row index, and of a column's index and value, as implied by the paper's sizes.
const PER_ROW: usize = 4;
const PER_COLUMN: usize = 8;

impl StoredTransfer for Biclustering {
    fn sizes(&self) -> Vec<StoredSize> {
        let bytes = (PER_ROW * self.row_entries() + PER_COLUMN * self.column_entries()) as u64;
        vec![StoredSize { layout: "4 bytes per row, 8 per column", bytes }]
    }

    fn multiply(&self, light: &[f64]) -> Vec<f64> {
        paper::multiply(self, light)
    }
}

/// Error: the matrix does not have one column per light texel.
pub fn columns_error(found: usize) -> InputError {
    input_error!("expected a matrix of {LIGHT_TEXELS} columns, a light texel each, found {found}")
}

/// Error: the matrix has no principal components.
pub(super) fn dark_error() -> InputError {
    input_error!("expected a row with a value other than 0, found none")
}
