//! Harmonics over the hemisphere z >= 0, where they are not orthogonal (appendix of the paper, section 9.1).

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::harmonics::{function_band, function_count, function_index, harmonics};
use super::singular::singular_values;
use crate::error::{InputError, ensure};
use crate::linalg::{Matrix, SymmetricEigen, dot};
use crate::quadrature;

/// Gram matrix A of harmonics over the hemisphere, A_ik the integral of y_i y_k, with its inverse and spectrum.
///
/// Functions of different m are orthogonal over the hemisphere too, so A is block diagonal. If the bands of two
/// functions of a block differ by an even number, their product has half of its integral over the sphere: 1/2 or 0.
/// Each block is M^T M, where M contains the functions at the points of a rule that is exact for their products.
/// Inverse and spectrum come from the singular values of M, so rounding errors are amplified only by the square root of
/// A's condition number.
#[derive(Clone, Debug)]
pub struct Hemisphere {
    order: usize,
    functions: Vec<usize>,
    gram: Matrix,
    inverse: Matrix,
    spectrum: SymmetricEigen,
}

impl Hemisphere {
    /// Builds the matrix of all n^2 functions of an order. Panics if the order is not 1 to 10.
    pub fn new(order: usize) -> Self {
        Self::without(order, &[]).expect("nothing is dropped")
    }

    /// Builds the matrix of the functions of an order except those with the indices `dropped`; section 6.1 drops l = 1,
    /// m = 0 (index 2) of order 5.
    pub fn without(order: usize, dropped: &[usize]) -> Result<Self, InputError> {
        let count = function_count(order);
        let mut kept = vec![true; count];
        for &found in dropped {
            ensure!(kept.get(found).is_some_and(|&kept| kept), "crossbar::prt::functions" =>
                "expected distinct functions below {count} to drop, found {found}");
            kept[found] = false;
        }
        let functions: Vec<usize> = (0..count).filter(|&index| kept[index]).collect();
        ensure!(!functions.is_empty(), "crossbar::prt::functions" =>
            "expected functions that are kept, found all {count} dropped");
        Ok(Self::of(order, functions))
    }

    fn of(order: usize, functions: Vec<usize>) -> Self {
        let size = functions.len();
        let zeros = || Matrix::zeros([size; 2]).expect("at most 100 rows and columns");
        let [mut gram, mut inverse, mut vectors] = [zeros(), zeros(), zeros()];
        let (values, mut eigen) = (radial(order), Vec::new());
        for m in 1 - order.cast_signed()..order.cast_signed() {
            let of_m: Vec<usize> = (0..size).filter(|&i| function_band(functions[i]).1 == m).collect();
            let azimuths = if m == 0 { TAU } else { PI };
            let column = |&i: &usize| -> Vec<f64> {
                let index = function_index(function_band(functions[i]).0, m.abs());
                values.iter().map(|(root, y)| azimuths.sqrt() * root * y[index]).collect()
            };
            let columns: Vec<Vec<f64>> = of_m.iter().map(column).collect();
            let singular = singular_values(columns.clone());
            write_block(&mut gram, &of_m, |a, b| match [a, b].map(|at| function_band(functions[of_m[at]]).0) {
                [l, k] if l == k => 0.5,
                [l, k] if (l + k) % 2 == 0 => 0.0,
                _ => dot(&columns[a], &columns[b]),
            });
            write_block(&mut inverse, &of_m, |a, b| singular.iter().map(|(s, v)| v[a] * v[b] / (s * s)).sum());
            eigen.extend(singular.into_iter().map(|(value, vector)| (value * value, vector, of_m.clone())));
        }
        eigen.sort_by(|(a, ..), (b, ..)| b.total_cmp(a));
        for (row, (_, vector, of_m)) in eigen.iter().enumerate() {
            let largest = vector.iter().fold(0.0, |most: f64, v| if v.abs() > most.abs() { *v } else { most });
            of_m.iter().zip(vector).for_each(|(&i, component)| vectors.row_mut(row)[i] = component * largest.signum());
        }
        let values = eigen.into_iter().map(|(value, ..)| value).collect();
        Self { order, functions, gram, inverse, spectrum: SymmetricEigen { values, vectors } }
    }

    /// Order n of the harmonics.
    pub const fn order(&self) -> usize {
        self.order
    }

    /// Indices of the functions of rows and columns, in ascending order.
    pub fn functions(&self) -> &[usize] {
        &self.functions
    }

    /// Gram matrix A.
    pub const fn gram(&self) -> &Matrix {
        &self.gram
    }

    /// Inverse of A. Its elements grow with the condition number of A, 10^5 at order 5 and 10^12 at order 10, and so
    /// does the relative error of products with it, in units of 2^-53; [`Self::least_squares`] avoids that.
    pub const fn inverse(&self) -> &Matrix {
        &self.inverse
    }

    /// Eigenvalues and eigenvectors of A.
    pub const fn spectrum(&self) -> &SymmetricEigen {
        &self.spectrum
    }

    /// Computes the least-squares coefficients A^-1 b of a function f, where b are the integrals of f y_k over the
    /// hemisphere.
    ///
    /// It works in the basis of A's eigenvectors, so that rounding errors are amplified only along eigenvectors that
    /// hardly change the function on the hemisphere: in values there, the amplification is only the square root of the
    /// condition number. Panics if there is not one integral per function.
    pub fn least_squares(&self, b: &[f64]) -> Vec<f64> {
        assert_eq!(b.len(), self.functions.len(), "an integral per function");
        let mut coefficients = vec![0.0; b.len()];
        for (value, vector) in self.spectrum.values.iter().zip(self.spectrum.vectors.rows()) {
            let along = dot(vector, b) / value;
            coefficients.iter_mut().zip(vector).for_each(|(c, v)| *c += along * v);
        }
        coefficients
    }

    /// For each function the squared error, over the hemisphere, of its best approximation by the others.
    pub fn drop_costs(&self) -> Vec<f64> {
        self.inverse.diagonal().into_iter().map(f64::recip).collect()
    }

    /// Squared norm over the hemisphere of the function with these coefficients, c^T A c.
    pub fn energy(&self, coefficients: &[f64]) -> f64 {
        assert_eq!(coefficients.len(), self.functions.len(), "a coefficient per function");
        coefficients.iter().zip(self.gram.times(coefficients)).map(|(c, b)| c * b).sum()
    }
}

/// For each Gauss point z in [0, 1], the square root of its weight, and the functions of an order at (sqrt(1 - z^2), 0,
/// z), where the azimuthal factor of m >= 0 is 1.
fn radial(order: usize) -> Vec<(f64, Vec<f64>)> {
    let points = quadrature::gauss_legendre(order).into_iter();
    let values = points.map(|(z, weight)| {
        let mut y = vec![0.0; function_count(order)];
        harmonics(order, DVec3::new(((1.0 - z) * (1.0 + z)).sqrt(), 0.0, z), &mut y);
        (weight.sqrt(), y)
    });
    values.collect()
}

/// Writes the elements of a block of functions into the whole matrix.
fn write_block(whole: &mut Matrix, block: &[usize], element: impl Fn(usize, usize) -> f64) {
    for (a, &row) in block.iter().enumerate() {
        for (b, &column) in block.iter().enumerate() {
            whole.row_mut(row)[column] = element(a, b);
        }
    }
}
