//! Responses of materials: the exit radiance, in an exit basis, per unit of radiance from each direction of a rule.

use std::f64::consts::PI;

use crate::error::InputError;
use crate::linalg::dot;
use crate::sphere::DirectionRule;
use crate::transfer::brdf::{Brdf, ExitBasis, Projector, exit_per_direction, integrals};
use crate::transfer::error::require;

/// The representation of incident radiance to which a glossy material's BRDF is applied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Incident {
    /// Spherical harmonics of this order, as in M_p = B R_p T_p, so that incident radiance is band-limited.
    Harmonics {
        /// The order; the paper uses 5.
        order: usize,
        /// True if A_i^-1 is applied between B and R_p T_p, as in equation 1.
        inverse: bool,
    },
    /// Directions, as in the double integral of section 3.1, with no band limit but the light's.
    Directions,
}

/// A material's exit radiance in an exit basis, per radiance from each direction of a rule, in the local frame. The
/// transfer matrix is the integral, over the unblocked directions, of a direction's column times its row of light
/// functions. With a rule that is exact for products of two functions, all further steps are linear algebra.
#[derive(Clone, Debug)]
pub struct Response {
    basis: ExitBasis,
    directions: usize,
    /// One column per direction.
    columns: Vec<f64>,
}

impl Response {
    /// A diffuse response: exit radiance is albedo / pi times irradiance. It has one row, the t_p of section 3.
    pub fn diffuse(albedo: f64, rule: &DirectionRule) -> Result<Self, InputError> {
        require((0.0..=1.0).contains(&albedo), "the albedo", "a number from 0 to 1", albedo)?;
        let columns = rule.directions().iter().map(|s| albedo / PI * s.z).collect();
        Ok(Self { basis: ExitBasis::Radiance, directions: rule.len(), columns })
    }

    /// The irradiance that enters a medium: cosine times the transmittance at that cosine. Its only row is not
    /// radiance, but the input of [`Transfer::scattered`](super::Transfer::scattered), and must not take part in
    /// interreflection.
    pub fn entering(transmittance: impl Fn(f64) -> f64, rule: &DirectionRule) -> Self {
        let columns = rule.directions().iter().map(|s| transmittance(s.z) * s.z).collect();
        Self { basis: ExitBasis::Radiance, directions: rule.len(), columns }
    }

    /// A glossy response in harmonics, for equation 1, M_p = A_r^-1 B A_i^-1 R_p T_p, or a variant. A_r^-1 is applied
    /// if `exit_inverse`; otherwise rows are the zero-hemisphere projection of exit radiance. `views` is the rule that
    /// integrates B ([`BRDF_DEGREE`](crate::transfer::brdf::BRDF_DEGREE)).
    pub fn glossy(
        brdf: &Brdf,
        exit: &ExitBasis,
        exit_inverse: bool,
        incident: Incident,
        rule: &DirectionRule,
        views: &DirectionRule,
    ) -> Result<Self, InputError> {
        brdf.check().map_err(|error| error.coded("crossbar::prt::precompute"))?;
        let projector = Projector::new(exit, exit_inverse);
        let columns = match incident {
            Incident::Directions => exit_per_direction(brdf, &projector, rule.directions(), views),
            Incident::Harmonics { order, inverse } => {
                let inner = ExitBasis::of_order(order);
                let inner = Projector::new(&inner, inverse);
                let b = integrals(brdf, &projector, &inner, views)?;
                let functions = inner.functions(rule.directions());
                let at = |values| b.rows().map(move |row| dot(row, values));
                functions.chunks_exact(b.column_count()).flat_map(at).collect()
            }
        };
        Ok(Self { columns: projector.coefficients(columns), basis: exit.clone(), directions: rule.len() })
    }

    /// The basis of exit radiance.
    pub fn basis(&self) -> &ExitBasis {
        &self.basis
    }

    /// Number of directions of the rule.
    pub fn direction_count(&self) -> usize {
        self.directions
    }

    /// The column of each direction.
    pub(crate) fn columns(&self) -> impl Iterator<Item = &[f64]> {
        self.columns.chunks_exact(self.basis.len())
    }
}
