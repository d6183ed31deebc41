//! The same table in spherical harmonics, the output basis of earlier work: the lower part of the table of section 3.

use super::disc::{HemisphereSamples, ProductErrors};
use crate::all_frequency::factor::error::of_svd;
use crate::error::InputError;
use crate::linalg::{Matrix, Svd};
use crate::sphere::{function_count, harmonics};

/// The projection of f above the horizon onto harmonics.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HarmonicFit {
    /// Integrals with the functions, f being 0 below the horizon.
    ZeroHemisphere,
    /// The combination that is nearest above the horizon.
    LeastSquares,
}

/// The sides of f that are expanded in harmonics.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HarmonicSides {
    /// The view: rows of a transfer matrix are its functions.
    View,
    /// The light.
    Light,
    /// Both, as in matrices of harmonics on both sides.
    Both,
}

/// Errors of harmonics of an order at samples above the horizon. Integrals are sums over these samples, weighted by
/// their solid angles.
///
/// # Errors
/// [`InputError`] if the functions depend on each other on so few samples that least squares has no
/// answer.
///
/// # Panics
/// If the order is not 1 to [`crate::sphere::MAX_ORDER`].
pub fn harmonic_errors(
    samples: &HemisphereSamples,
    order: usize,
    fit: HarmonicFit,
    sides: HarmonicSides,
) -> Result<ProductErrors, InputError> {
    let [view, light] = [0, 1].map(|side| Expansion::new(samples, side, order, fit));
    let values = match sides {
        HarmonicSides::Light => light?.columns(&samples.values)?,
        HarmonicSides::View => view?.rows(&samples.values)?,
        HarmonicSides::Both => view?.rows(&light?.columns(&samples.values)?)?,
    };
    Ok(samples.errors_of(&values))
}

/// Converts values at texels to coefficients, and back.
struct Expansion {
    /// A row per function.
    analysis: Matrix,
    /// A row per function.
    synthesis: Matrix,
}

impl Expansion {
    fn new(samples: &HemisphereSamples, side: usize, order: usize, fit: HarmonicFit) -> Result<Self, InputError> {
        let (directions, angles) = (&samples.directions[side], &samples.solid_angles[side]);
        let count = function_count(order);
        let mut y = Matrix::zeros([directions.len(), count]).map_err(of_svd)?;
        for (row, &direction) in directions.iter().enumerate() {
            harmonics(order, direction, y.row_mut(row));
        }
        let scaled = |matrix: &Matrix, by: &dyn Fn(f64) -> f64| {
            let mut matrix = matrix.clone();
            for (row, &angle) in angles.iter().enumerate() {
                matrix.row_mut(row).iter_mut().for_each(|value| *value *= by(angle));
            }
            matrix
        };
        Ok(match fit {
            HarmonicFit::ZeroHemisphere => {
                Self { analysis: scaled(&y, &|angle| angle).transposed(), synthesis: y.transposed() }
            }
            HarmonicFit::LeastSquares => {
                // An orthonormal basis of the same functions, under the weights.
                let basis = Svd::new(&scaled(&y, &f64::sqrt)).map_err(of_svd)?.left;
                let analysis = scaled(&basis, &f64::sqrt).transposed();
                Self { analysis, synthesis: scaled(&basis, &|angle| 1.0 / angle.sqrt()).transposed() }
            }
        })
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
    use crate::transfer::brdf::Brdf;

    fn disc(side: usize, product: &dyn super::super::ProductFunction) -> HemisphereSamples {
        let sampling = FactorSampling { side, supersamples: Supersamples::NONE, ..FactorSampling::default() };
        let table: ProductTable = sampling.table(product, &mut |_, _| ()).expect("a table");
        DiscSamples::new(&table).samples().clone()
    }

    #[test]
    fn a_function_of_the_basis_is_met_by_least_squares() {
        let lambert = disc(12, &Brdf::Lambert { albedo: 0.7 });
        for sides in [HarmonicSides::View, HarmonicSides::Light, HarmonicSides::Both] {
            let errors = harmonic_errors(&lambert, 2, HarmonicFit::LeastSquares, sides).expect("errors");
            assert!(errors.max < 1e-14, "{sides:?}: {}", errors.max);
            let zero = harmonic_errors(&lambert, 2, HarmonicFit::ZeroHemisphere, sides).expect("errors");
            assert!(zero.max > 0.05, "half of the sphere is 0: {}", zero.max);
        }
    }

    #[test]
    fn errors_fall_with_the_order_and_least_squares_is_nearest() {
        let lobe = disc(16, &Lobe::cook_torrance(0.4, 0.5));
        for sides in [HarmonicSides::View, HarmonicSides::Light, HarmonicSides::Both] {
            let of = |order, fit| harmonic_errors(&lobe, order, fit, sides).expect("errors");
            let squares: Vec<f64> = (4..=7).map(|order| of(order, HarmonicFit::LeastSquares).rms).collect();
            assert!(squares.windows(2).all(|two| two[1] < two[0]), "{sides:?}: {squares:?}");
            assert!(squares[1] < of(5, HarmonicFit::ZeroHemisphere).rms, "{sides:?}");
        }
    }
}
