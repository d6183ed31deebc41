//! The same table in spherical harmonics, the output basis of earlier work: the lower part of the table of section 3.

use super::disc::{HemisphereSamples, ProductErrors};
use crate::all_frequency::factor::error::of_svd;
use crate::error::InputError;
use crate::linalg::Matrix;
use crate::sphere::{function_count, harmonics};

/// Errors of harmonics of an order on both sides, at samples above the horizon. Coefficients are integrals with the
/// functions, f being 0 below the horizon: sums over these samples, weighted by their solid angles.
///
/// # Errors
/// [`InputError`] if a matrix is too large.
///
/// # Panics
/// If the order is not 1 to [`crate::sphere::MAX_ORDER`].
pub fn harmonic_errors(samples: &HemisphereSamples, order: usize) -> Result<ProductErrors, InputError> {
    let [view, light] = [0, 1].map(|side| Expansion::new(samples, side, order));
    Ok(samples.errors_of(&view?.rows(&light?.columns(&samples.values)?)?))
}

/// Converts values at texels to coefficients, and back.
struct Expansion {
    /// A row per function.
    analysis: Matrix,
    /// A row per function.
    synthesis: Matrix,
}

impl Expansion {
    fn new(samples: &HemisphereSamples, side: usize, order: usize) -> Result<Self, InputError> {
        let (directions, angles) = (&samples.directions[side], &samples.solid_angles[side]);
        let mut y = Matrix::zeros([directions.len(), function_count(order)]).map_err(of_svd)?;
        for (row, &direction) in directions.iter().enumerate() {
            harmonics(order, direction, y.row_mut(row));
        }
        let synthesis = y.transposed();
        for (row, &angle) in angles.iter().enumerate() {
            y.row_mut(row).iter_mut().for_each(|value| *value *= angle);
        }
        Ok(Self { analysis: y.transposed(), synthesis })
    }

    /// Expands each row of a matrix.
    fn columns(&self, values: &Matrix) -> Result<Matrix, InputError> {
        let analysed = values.product(&self.analysis.transposed());
        analysed.and_then(|analysed| analysed.product(&self.synthesis)).map_err(of_svd)
    }

    /// Expands each column.
    fn rows(&self, values: &Matrix) -> Result<Matrix, InputError> {
        let analysed = self.analysis.product(values);
        analysed.and_then(|analysed| self.synthesis.transposed().product(&analysed)).map_err(of_svd)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::all_frequency::factor::{DiscSamples, FactorSampling, Lobe, ProductTable, Supersamples};

    fn disc(side: usize, product: &dyn super::super::ProductFunction) -> HemisphereSamples {
        let sampling = FactorSampling { side, supersamples: Supersamples::NONE, ..FactorSampling::default() };
        let table: ProductTable = sampling.table(product, &mut |_, _| ()).expect("a table");
        DiscSamples::new(&table).samples().clone()
    }

    #[test]
    fn errors_fall_with_the_order() {
        let lobe = disc(16, &Lobe::cook_torrance(0.4, 0.5));
        let [four, seven] = [4, 7].map(|order| harmonic_errors(&lobe, order).expect("errors"));
        assert!(seven.rms < four.rms && four.rms > 0.0, "{} {}", seven.rms, four.rms);
    }
}
