//! How a material answers light: the exit radiance, in an exit basis, per unit of radiance that arrives from each
//! direction of a rule.

use std::f64::consts::PI;

use super::error::TransferError;
use crate::linalg::{Matrix, MatrixError, dot};
use crate::prt::brdf::{Brdf, ExitBasis, brdf_matrix, exit_per_direction};
use crate::sphere::{DirectionRule, Hemisphere, function_count, harmonics};

/// How incident radiance reaches the BRDF of a glossy material.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Incident {
    /// Through spherical harmonics of this order, as in M_p = B R_p T_p: incident radiance is cut to their band.
    Harmonics {
        /// The order; the paper takes 5.
        order: usize,
        /// Whether A_i^-1 stands between B and R_p T_p, as in equation 1.
        inverse: bool,
    },
    /// Direction by direction, as in the double integral of section 3.1: no band but that of the light.
    Directions,
}

/// A material's exit radiance in an exit basis, per radiance that arrives from each direction of a rule, in the local
/// frame. With a rule that is exact for products of two functions, everything that follows is linear algebra: the
/// transfer matrix is the integral of this column times the row of light functions, over the directions that see light.
#[derive(Clone, Debug)]
pub struct Response {
    basis: ExitBasis,
    /// The rule's directions.
    directions: usize,
    /// A column per direction.
    columns: Vec<f64>,
}

impl Response {
    /// Diffuse: exit radiance is albedo / pi times irradiance. One row, the t_p of section 3.
    ///
    /// # Errors
    /// [`TransferError::OutOfRange`] if the albedo is not in [0, 1].
    pub fn diffuse(albedo: f64, rule: &DirectionRule) -> Result<Self, TransferError> {
        if !(0.0..=1.0).contains(&albedo) {
            let (what, expected) = ("the albedo", "a number from 0 to 1");
            return Err(TransferError::OutOfRange { what, expected, found: albedo });
        }
        let columns = rule.directions().iter().map(|s| albedo / PI * s.z).collect();
        Ok(Self { basis: ExitBasis::Radiance, directions: rule.len(), columns })
    }

    /// Glossy, in harmonics: equation 1, M_p = A_r^-1 B A_i^-1 R_p T_p, or one of its relatives. `exit_inverse` says
    /// whether A_r^-1 is applied; without, rows are the zero-hemisphere projection of exit radiance. `views` is the rule
    /// that B is integrated with ([`BRDF_DEGREE`](crate::prt::brdf::BRDF_DEGREE)).
    ///
    /// # Errors
    /// [`TransferError::Brdf`] for figures out of range.
    pub fn glossy(
        brdf: &Brdf,
        exit: &ExitBasis,
        exit_inverse: bool,
        incident: Incident,
        rule: &DirectionRule,
        views: &DirectionRule,
    ) -> Result<Self, TransferError> {
        brdf.check()?;
        let columns = match incident {
            Incident::Directions => exit_per_direction(brdf, exit, rule.directions(), views),
            Incident::Harmonics { order, inverse } => {
                let b = brdf_matrix(brdf, exit, order, views)?;
                let b = if inverse { b.product(Hemisphere::new(order).inverse())? } else { b };
                applied(&b, order, rule)
            }
        };
        Ok(Self { columns: fitted(columns, exit, exit_inverse), basis: exit.clone(), directions: rule.len() })
    }

    /// No material at all: the answer is the incident radiance itself, projected onto a basis by integrals over the
    /// hemisphere, or with `inverse` by least squares.
    pub(super) fn incident(basis: &ExitBasis, inverse: bool, rule: &DirectionRule) -> Self {
        let mut columns = vec![0.0; basis.len() * rule.len()];
        for (&s, into) in rule.directions().iter().zip(columns.chunks_exact_mut(basis.len())) {
            basis.values(s, into);
        }
        Self { columns: fitted(columns, basis, inverse), basis: basis.clone(), directions: rule.len() }
    }

    /// What exit radiance is expressed in.
    pub fn basis(&self) -> &ExitBasis {
        &self.basis
    }

    /// The number of directions of the rule.
    pub fn direction_count(&self) -> usize {
        self.directions
    }

    /// The column of each direction.
    pub(crate) fn columns(&self) -> impl Iterator<Item = &[f64]> {
        self.columns.chunks_exact(self.basis.len())
    }

    /// The matrix that a vertex has which sees the whole hemisphere, for light of an order in local coordinates.
    ///
    /// # Errors
    /// [`MatrixError`] never, since there are at most 100 functions.
    ///
    /// # Panics
    /// If the order is not 1 to 10, or the rule is not of as many directions as the response's.
    pub fn unoccluded(&self, light_order: usize, rule: &DirectionRule) -> Result<Matrix, MatrixError> {
        assert_eq!(rule.len(), self.directions, "the response's rule");
        let columns = function_count(light_order);
        let (mut sums, mut y) = (Matrix::zeros([self.basis.len(), columns])?, vec![0.0; columns]);
        for ((&s, weight), exits) in rule.directions().iter().zip(rule.weights()).zip(self.columns()) {
            harmonics(light_order, s, &mut y);
            for (row, exit) in exits.iter().enumerate() {
                sums.row_mut(row).iter_mut().zip(&y).for_each(|(sum, y)| *sum += weight * exit * y);
            }
        }
        Ok(sums)
    }
}

/// A matrix times the harmonics at each direction.
fn applied(matrix: &Matrix, order: usize, rule: &DirectionRule) -> Vec<f64> {
    let mut y = vec![0.0; function_count(order)];
    let mut columns = Vec::with_capacity(matrix.row_count() * rule.len());
    for &s in rule.directions() {
        harmonics(order, s, &mut y);
        columns.extend(matrix.rows().map(|row| dot(row, &y)));
    }
    columns
}

/// With `inverse`, A^-1 times each column.
fn fitted(columns: Vec<f64>, basis: &ExitBasis, inverse: bool) -> Vec<f64> {
    match basis {
        ExitBasis::Harmonics(hemisphere) if inverse => {
            let of = |column| hemisphere.inverse().rows().map(move |row| dot(row, column));
            columns.chunks_exact(basis.len()).flat_map(of).collect()
        }
        _ => columns,
    }
}
