//! Rows in wavelets and in clusters by plain loops over dense rows, to compare with.

use crate::bi_scale::matrix::SparseMatrix;
use crate::transfer::grid::{LIGHT_SIDE, LIGHT_TEXELS};
use crate::transfer::haar::Haar;

use super::haar_rows::CoefficientPriority;

/// A row of a matrix, including all zeros.
///
/// # Panics
/// If there is no such row.
pub fn dense_row(matrix: &SparseMatrix, row: usize) -> Vec<f64> {
    let mut dense = vec![0.0; matrix.columns()];
    for entry in matrix.row(row) {
        dense[entry.index as usize] = matrix.value(entry.value);
    }
    dense
}

/// A row from its `keep` largest wavelet coefficients: all six faces transformed, all coefficients sorted, the others
/// set to 0, and transformed back.
///
/// # Panics
/// If the row has not a number per light texel.
pub fn by_largest_coefficients(row: &[f64], keep: usize, priority: CoefficientPriority) -> Vec<f64> {
    assert_eq!(row.len(), LIGHT_TEXELS, "a number per light texel");
    let face = LIGHT_SIDE * LIGHT_SIDE;
    let mut haar = Haar::new(LIGHT_SIDE);
    let mut coefficients = row.to_vec();
    for of_face in coefficients.chunks_exact_mut(face) {
        haar.forward(of_face);
    }
    let mut order: Vec<(f64, usize)> = Vec::new();
    for (at, value) in coefficients.iter().enumerate() {
        let side = haar.support(at % face).side as f64;
        let weight = match priority {
            CoefficientPriority::Area => side * side,
            CoefficientPriority::Magnitude => 1.0,
        };
        order.push((weight * value.abs(), at));
    }
    order.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    for &(_, at) in &order[keep.min(order.len())..] {
        coefficients[at] = 0.0;
    }
    for of_face in coefficients.chunks_exact_mut(face) {
        haar.inverse(of_face);
    }
    coefficients
}
