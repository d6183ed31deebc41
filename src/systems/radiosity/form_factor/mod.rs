//! Form factors: F_ij is the fraction of the light leaving patch i that reaches patch j directly.
//!
//! - unoccluded: Gauss quadrature for distant patches, a contour integral for near ones, both in f64;
//! - with visibility: the unoccluded factor times the weighted fraction of unoccluded sample rays;
//! - for the open parts of patches ([`Patches::open_parts`](super::Patches::open_parts)), which no solid covers;
//! - from a point, in closed form ([`point_to_polygon`]);
//! - reciprocity and closure (rows of a closed room sum to 1) can be checked and enforced.

mod closure;
mod contour;
mod exchange;
mod polygon;
mod rows;
mod visibility;

use crate::error::{InputError, ensure, input_error};
use crate::linalg::Matrix;

pub use closure::RowSums;
pub use polygon::point_to_polygon;
pub use visibility::VisibilityParameters;

/// The form factors between all patches of a scene, with the patches' areas.
#[derive(Clone, Debug, PartialEq)]
pub struct FormFactors {
    areas: Vec<f64>,
    matrix: Matrix,
}

impl FormFactors {
    /// Creates form factors from a matrix with F_ij in row i, column j. Fails with [`InputError`] if the matrix is not
    /// square, there is not one positive area per row, or a form factor is negative or NaN.
    pub fn from_values(areas: Vec<f64>, matrix: Matrix) -> Result<Self, InputError> {
        let [rows, columns] = [matrix.row_count(), matrix.column_count()];
        ensure!(matrix.is_square(), "radiosity::form_factors" =>
            "expected {rows} x {rows} values, found {}", rows * columns);
        ensure!(areas.len() == rows, "radiosity::form_factors" =>
            "expected {rows} areas, one per row, found {}", areas.len());
        for (patch, (&area, row)) in areas.iter().zip(matrix.rows()).enumerate() {
            let wrong = |expected: &str, value: f64| {
                Err(input_error!("radiosity::form_factors" =>
                    "expected {expected}, found {value} for patch {patch} (counted from 0)"))
            };
            if !(area > 0.0 && area.is_finite()) {
                return wrong("an area above 0", area);
            }
            if let Some(&value) = row.iter().find(|&&f| !(f >= 0.0 && f.is_finite())) {
                return wrong("form factors of at least 0", value);
            }
        }
        Ok(Self { areas, matrix })
    }

    /// Number of patches.
    pub fn len(&self) -> usize {
        self.areas.len()
    }

    /// Returns `true` if there are no patches.
    pub fn is_empty(&self) -> bool {
        self.areas.is_empty()
    }

    /// Areas of the open parts of the patches, see [`Patches::areas`](super::Patches::areas).
    pub fn areas(&self) -> &[f64] {
        &self.areas
    }

    /// F_ij in row i, column j.
    pub fn matrix(&self) -> &Matrix {
        &self.matrix
    }
}
