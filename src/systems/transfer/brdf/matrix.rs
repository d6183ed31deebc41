//! BRDF matrices (section 3.1): B_ij is the integral over view and light directions of y_i(v) y_j(s) B(v, s) s_z.

use glam::DVec3;
use rayon::prelude::*;

use super::models::Brdf;
use crate::error::InputError;
use crate::linalg::{Matrix, dot};
use crate::sphere::{DirectionRule, Hemisphere, MAX_ORDER, function_count, function_index, harmonics};

/// The default degree of the direction rule for BRDF matrices: 48 rings of 96 directions.
pub const BRDF_DEGREE: usize = 95;

/// The basis of exit radiance, which determines the rows of a transfer matrix.
#[derive(Clone, Debug)]
pub enum ExitBasis {
    /// Radiance that is equal in all directions, for diffuse transfer: one row.
    Radiance,
    /// Spherical harmonics in the local frame.
    Harmonics(Hemisphere),
}

impl ExitBasis {
    /// All functions of an order: 16 for order 4, 25 for order 5. Panics if the order is not 1 to [`MAX_ORDER`].
    pub fn of_order(order: usize) -> Self {
        Self::Harmonics(Hemisphere::new(order))
    }

    /// All functions of an order except (l, m) = (1, 0), which is nearly redundant on the hemisphere: 24 for order 5
    /// (section 6.1). Fails with [`InputError`] for order 1, which has no such function. Panics if the order is not 1
    /// to [`MAX_ORDER`].
    pub fn without_1_0(order: usize) -> Result<Self, InputError> {
        Hemisphere::without(order, &[function_index(1, 0)]).map(Self::Harmonics)
    }

    /// The basis with the given functions, l (l + 1) + m, increasing; only function 0 means radiance, as in `.npz`
    /// files. Fails with [`InputError`] for no functions. Panics if a function belongs to an order above [`MAX_ORDER`].
    pub fn of_functions(functions: &[u16]) -> Result<Self, InputError> {
        if functions == [0] {
            return Ok(Self::Radiance);
        }
        let functions: Vec<usize> = functions.iter().map(|&function| function.into()).collect();
        let order = functions.last().map_or(1, |last| last.isqrt() + 1);
        let dropped: Vec<usize> = (0..function_count(order)).filter(|function| !functions.contains(function)).collect();
        Hemisphere::without(order, &dropped).map(Self::Harmonics)
    }

    /// The number of functions.
    pub fn len(&self) -> usize {
        match self {
            Self::Radiance => 1,
            Self::Harmonics(hemisphere) => hemisphere.functions().len(),
        }
    }

    /// Always false: there is at least one function.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Indices of the harmonics; none for radiance.
    pub fn functions(&self) -> &[usize] {
        match self {
            Self::Radiance => &[],
            Self::Harmonics(hemisphere) => hemisphere.functions(),
        }
    }

    /// The functions' values at a local direction. Panics if `into` does not have one element per function.
    pub fn values(&self, local: DVec3, into: &mut [f64]) {
        assert_eq!(into.len(), self.len(), "a place per function");
        match self {
            Self::Radiance => into[0] = 1.0,
            Self::Harmonics(hemisphere) => {
                let mut all = [0.0; MAX_ORDER * MAX_ORDER];
                harmonics(hemisphere.order(), local, &mut all[..function_count(hemisphere.order())]);
                into.iter_mut().zip(hemisphere.functions()).for_each(|(value, &index)| *value = all[index]);
            }
        }
    }
}

/// A basis with the functions whose integrals project onto the basis.
///
/// Least squares applies A^-1, with condition number 151,695 for order 5, and equation 1 does so twice. With integrals
/// of the basis functions, rounding errors would be amplified by the square of this number. With integrals of the
/// orthonormal combinations psi = W^T y, where A^-1 = W W^T, each side amplifies only by its square root: a function's
/// coefficients are W times its integrals with psi.
pub(crate) struct Projector<'a> {
    basis: &'a ExitBasis,
    /// W^T, one row per combination; `None` for integrals with the basis functions themselves.
    combinations: Option<Matrix>,
}

impl<'a> Projector<'a> {
    /// Creates a projector onto least-squares coefficients in a basis if `inverse`, else onto integrals with its
    /// functions.
    pub(crate) fn new(basis: &'a ExitBasis, inverse: bool) -> Self {
        let combinations = match basis {
            ExitBasis::Harmonics(hemisphere) if inverse => {
                let mut vectors = hemisphere.spectrum().vectors.clone();
                for (k, value) in hemisphere.spectrum().values.iter().enumerate() {
                    vectors.row_mut(k).iter_mut().for_each(|component| *component /= value.sqrt());
                }
                Some(vectors)
            }
            _ => None,
        };
        Self { basis, combinations }
    }

    /// The functions to integrate with, at each direction: one row per direction, concatenated.
    pub(crate) fn functions(&self, directions: &[DVec3]) -> Vec<f64> {
        let mut y = vec![0.0; self.basis.len()];
        let mut values = Vec::with_capacity(y.len() * directions.len());
        for &direction in directions {
            self.basis.values(direction, &mut y);
            match &self.combinations {
                Some(rows) => values.extend(rows.rows().map(|row| dot(row, &y))),
                None => values.extend_from_slice(&y),
            }
        }
        values
    }

    /// Converts rows of integrals, one integral per function, to coefficients.
    pub(crate) fn coefficients(&self, integrals: Vec<f64>) -> Vec<f64> {
        let Some(rows) = &self.combinations else { return integrals };
        let columns = rows.transposed();
        integrals.chunks_exact(self.basis.len()).flat_map(|of| columns.rows().map(move |row| dot(row, of))).collect()
    }
}

/// The matrix B of a BRDF, without either inverse: one row per function of the exit basis, one column per function of
/// the incident order, integrated by a rule over the hemisphere for both directions. Never fails, because there are at
/// most 100 functions. Panics if the order is not 1 to [`MAX_ORDER`].
pub fn brdf_matrix(
    brdf: &Brdf,
    exit: &ExitBasis,
    incident_order: usize,
    rule: &DirectionRule,
) -> Result<Matrix, InputError> {
    let incident = ExitBasis::of_order(incident_order);
    integrals(brdf, &Projector::new(exit, false), &Projector::new(&incident, false), rule)
}

/// The integrals of B(v, s) s_z with the functions of two projectors.
pub(crate) fn integrals(
    brdf: &Brdf,
    exit: &Projector<'_>,
    incident: &Projector<'_>,
    rule: &DirectionRule,
) -> Result<Matrix, InputError> {
    let table = exit_per_direction(brdf, exit, rule.directions(), rule);
    let (rows, columns) = (exit.basis.len(), incident.basis.len());
    let mut sums = Matrix::zeros([rows, columns])?;
    let functions = incident.functions(rule.directions());
    for ((weight, exits), values) in
        rule.weights().iter().zip(table.chunks_exact(rows)).zip(functions.chunks_exact(columns))
    {
        for (row, exit) in exits.iter().enumerate() {
            sums.row_mut(row).iter_mut().zip(values).for_each(|(sum, value)| *sum += weight * exit * value);
        }
    }
    Ok(sums)
}

/// For each light direction s, the integrals over views of the projector's functions times B(v, s) s_z: exit radiance
/// per incident radiance and steradian. This is the inner integral of section 3.1's formula.
pub(crate) fn exit_per_direction(
    brdf: &Brdf,
    exit: &Projector<'_>,
    lights: &[DVec3],
    views: &DirectionRule,
) -> Vec<f64> {
    let rows = exit.basis.len();
    let mut weighted = exit.functions(views.directions());
    for (values, weight) in weighted.chunks_exact_mut(rows).zip(views.weights()) {
        values.iter_mut().for_each(|value| *value *= weight);
    }
    let mut table = vec![0.0; rows * lights.len()];
    table.par_chunks_exact_mut(rows).zip(lights).for_each(|(into, &s)| {
        for (&view, values) in views.directions().iter().zip(weighted.chunks_exact(rows)) {
            let radiance = brdf.value(view, s) * s.z;
            into.iter_mut().zip(values).for_each(|(sum, value)| *sum += radiance * value);
        }
    });
    table
}
