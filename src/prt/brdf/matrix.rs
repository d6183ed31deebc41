//! BRDF matrices (section 3.1): B_ij is the integral over view and light directions of y_i(v) y_j(s) B(v, s) s_z.

use glam::DVec3;
use rayon::prelude::*;

use super::models::Brdf;
use crate::linalg::{Matrix, MatrixError};
use crate::sphere::{
    DirectionRule, Hemisphere, HemisphereError, MAX_ORDER, function_count, function_index, harmonics,
};

/// The degree of the direction rule that BRDF matrices are integrated with by default: 48 rings of 96 directions.
pub const BRDF_DEGREE: usize = 95;

/// What exit radiance is expressed in: the rows of a transfer matrix.
#[derive(Clone, Debug)]
pub enum ExitBasis {
    /// The radiance itself, the same in all directions: one row. Diffuse transfer.
    Radiance,
    /// Spherical harmonics in the local frame.
    Harmonics(Hemisphere),
}

impl ExitBasis {
    /// All functions of an order: 16 for order 4, 25 for order 5.
    ///
    /// # Panics
    /// If the order is not 1 to [`MAX_ORDER`].
    pub fn of_order(order: usize) -> Self {
        Self::Harmonics(Hemisphere::new(order))
    }

    /// All functions of an order but (l, m) = (1, 0), which is nearly redundant on the hemisphere: 24 for order 5
    /// (section 6.1).
    ///
    /// # Errors
    /// [`HemisphereError`] for order 1, which has no such function.
    ///
    /// # Panics
    /// If the order is not 1 to [`MAX_ORDER`].
    pub fn without_1_0(order: usize) -> Result<Self, HemisphereError> {
        Hemisphere::without(order, &[function_index(1, 0)]).map(Self::Harmonics)
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

    /// The functions' values at a local direction.
    ///
    /// # Panics
    /// If there is not one place per function.
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

/// The matrix B of a BRDF: a row per function of the exit basis, a column per function of the incident order, by a rule
/// over the hemisphere for both directions. Without either inverse.
///
/// # Errors
/// [`MatrixError`] never, since there are at most 100 functions.
///
/// # Panics
/// If the order is not 1 to [`MAX_ORDER`].
pub fn brdf_matrix(
    brdf: &Brdf,
    exit: &ExitBasis,
    incident_order: usize,
    rule: &DirectionRule,
) -> Result<Matrix, MatrixError> {
    let table = exit_per_direction(brdf, exit, rule.directions(), rule);
    let columns = function_count(incident_order);
    let mut sums = Matrix::zeros([exit.len(), columns])?;
    let mut y = vec![0.0; columns];
    for ((&s, weight), exits) in rule.directions().iter().zip(rule.weights()).zip(table.chunks_exact(exit.len())) {
        harmonics(incident_order, s, &mut y);
        for (i, value) in exits.iter().enumerate() {
            sums.row_mut(i).iter_mut().zip(&y).for_each(|(sum, y)| *sum += weight * value * y);
        }
    }
    Ok(sums)
}

/// For each light direction s the integrals over views of y_i(v) B(v, s) s_z: exit radiance per unit of radiance that
/// arrives from s within a steradian. The inner integral of section 3.1's formula.
pub(crate) fn exit_per_direction(
    brdf: &Brdf,
    exit: &ExitBasis,
    lights: &[DVec3],
    views: &DirectionRule,
) -> Vec<f64> {
    let rows = exit.len();
    let mut weighted = vec![0.0; rows * views.len()];
    for ((&view, weight), into) in views.directions().iter().zip(views.weights()).zip(weighted.chunks_exact_mut(rows)) {
        exit.values(view, into);
        into.iter_mut().for_each(|value| *value *= weight);
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
