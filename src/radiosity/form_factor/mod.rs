//! Form factors: F_ij is the share of the light leaving patch i that arrives at patch j without meeting anything else.
//!
//! - between two patches with nothing in between: a Gauss product far away, a contour integral near by, both in f64;
//! - with something in between: that, times the share of sample rays that get through, asked of whoever traces;
//! - by hemicubes that a card draws ([`FormFactors::hemicube`]);
//! - patches by their open parts ([`Patches::open_parts`]): areas and form factors are those of what nothing stands on;
//! - for rectangles in closed form ([`rectangles`]), from a point in closed form ([`point_to_polygon`]);
//! - checks and their enforcement: reciprocity, and rows that sum to 1 in a closed room.

mod closure;
mod contour;
mod exchange;
mod gauss;
mod hemicube;
mod polygon;
pub mod rectangles;
mod visibility;

use rayon::prelude::*;
use thiserror::Error;

use super::{DrawError, Patches};
use crate::linalg::{Matrix, MatrixError};
use crate::tracer::{CastError, Caster};
use exchange::Prepared;

pub use closure::RowSums;
pub use hemicube::Hemicube;
pub(super) use polygon::clipped;
pub use polygon::point_to_polygon;
pub use visibility::VisibilityParameters;
pub(super) use visibility::point_share;

/// Why there are no form factors, or not such as were asked for.
#[derive(Debug, Error)]
pub enum FormFactorError {
    /// The matrix would be too large.
    #[error(transparent)]
    Size(#[from] MatrixError),
    /// Not one area a row.
    #[error("expected {rows} areas, one a row, found {areas}")]
    Areas {
        /// Rows of the matrix.
        rows: usize,
        /// Areas given.
        areas: usize,
    },
    /// An area or form factor that cannot be one.
    #[error("expected {expected}, found {value} for patch {patch} (counted from 0)")]
    Value {
        /// What was expected.
        expected: &'static str,
        /// What was found.
        value: f64,
        /// The patch.
        patch: usize,
    },
    /// Light gets out.
    #[error(
        "expected a closed room, found patch {patch} (counted from 0) with form factors that sum to {sum}, and {open} of {patches} \
         patches more than {tolerance} from 1 ({blind} more see nothing); close the room, or allow light to leave it"
    )]
    Open {
        /// The patch farthest from 1.
        patch: usize,
        /// Its sum.
        sum: f64,
        /// Patches outside the tolerance.
        open: usize,
        /// Patches that see nothing at all.
        blind: usize,
        /// All patches.
        patches: usize,
        /// The tolerance.
        tolerance: f64,
    },
    /// Rows cannot be made to sum to 1 by scaling.
    #[error(
        "form factors cannot be scaled to a closed room: after {rounds} rounds patch {patch} (counted from 0) still sums to {sum}"
    )]
    NoScaling {
        /// Rounds tried.
        rounds: u32,
        /// The patch farthest from 1.
        patch: usize,
        /// Its sum.
        sum: f64,
    },
    /// A side of patches without samples.
    #[error("expected 1 sample or more along a side of a patch, found 0")]
    NoSamples,
    /// A hemicube that the card cannot draw.
    #[error(
        "expected an even number of pixels from 2 to {most} along a side of a hemicube, found {found}; its five faces lie in one target, \
         which {device} allows {limit} pixels a side"
    )]
    Resolution {
        /// What was asked for.
        found: u32,
        /// The most.
        most: u32,
        /// The device.
        device: String,
        /// Its limit.
        limit: u32,
    },
    /// The card could not draw.
    #[error(transparent)]
    Draw(#[from] DrawError),
    /// Whoever traces could not.
    #[error(transparent)]
    Cast(#[from] CastError),
}

/// The form factors between all patches of a scene, with the patches' areas.
#[derive(Clone, Debug, PartialEq)]
pub struct FormFactors {
    areas: Vec<f64>,
    matrix: Matrix,
}

impl FormFactors {
    /// Form factors from elsewhere: row i, column j is F_ij.
    ///
    /// # Errors
    /// [`FormFactorError`] if there is not one positive area a row, or a form factor is negative or no number.
    pub fn from_values(areas: Vec<f64>, matrix: Matrix) -> Result<Self, FormFactorError> {
        if areas.len() != matrix.size() {
            return Err(FormFactorError::Areas { rows: matrix.size(), areas: areas.len() });
        }
        for (patch, (&area, row)) in areas.iter().zip(matrix.rows()).enumerate() {
            if !(area > 0.0 && area.is_finite()) {
                return Err(FormFactorError::Value { expected: "an area above 0", value: area, patch });
            }
            if let Some(&value) = row.iter().find(|&&f| !(f >= 0.0 && f.is_finite())) {
                return Err(FormFactorError::Value { expected: "form factors of at least 0", value, patch });
            }
        }
        Ok(Self { areas, matrix })
    }

    /// As if nothing stood between any two patches: right for convex rooms, and the first step for others. Reciprocal to the last bit
    /// but one.
    ///
    /// # Errors
    /// [`FormFactorError::Size`] for too many patches.
    pub fn unoccluded(patches: &Patches) -> Result<Self, FormFactorError> {
        Ok(Self::from_exchanges(patches.areas(), exchanges(patches)?))
    }

    /// With what stands between patches: each unoccluded form factor times the share of the exchange that sample rays find open.
    /// `caster` traces [`Patches::mesh`] from both sides. `done` hears of pairs done, and of how many.
    ///
    /// # Errors
    /// [`FormFactorError`] for too many patches, no samples, or rays that could not be traced.
    pub fn with_visibility(
        patches: &Patches,
        caster: &mut dyn Caster,
        parameters: VisibilityParameters,
        done: &mut dyn FnMut(usize, usize),
    ) -> Result<Self, FormFactorError> {
        let mut exchanges = exchanges(patches)?;
        visibility::hide(patches, &mut exchanges, caster, parameters, done)?;
        Ok(Self::from_exchanges(patches.areas(), exchanges))
    }

    /// From area times form factor above the diagonal.
    fn from_exchanges(areas: Vec<f64>, mut matrix: Matrix) -> Self {
        mirror(&mut matrix);
        matrix.par_rows_mut().zip(&areas).for_each(|(row, area)| row.iter_mut().for_each(|x| *x /= area));
        Self { areas, matrix }
    }

    /// How many patches.
    #[must_use]
    pub fn len(&self) -> usize {
        self.areas.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.areas.is_empty()
    }

    /// The areas of the patches: of their open parts, see [`Patches::areas`].
    #[must_use]
    pub fn areas(&self) -> &[f64] {
        &self.areas
    }

    /// F_ij in row i, column j.
    #[must_use]
    pub fn matrix(&self) -> &Matrix {
        &self.matrix
    }
}

/// Area times form factor of the open parts of every two patches, above the diagonal, with nothing between them.
fn exchanges(patches: &Patches) -> Result<Matrix, FormFactorError> {
    let parts = |i| patches.open_parts(i).iter().map(Prepared::new).collect();
    let list: Vec<Vec<Prepared<'_>>> = (0..patches.list().len()).map(parts).collect();
    let mut matrix = Matrix::zero(list.len())?;
    matrix.par_rows_mut().enumerate().for_each(|(i, row)| {
        for (into, others) in row.iter_mut().zip(&list).skip(i + 1) {
            for one in &list[i] {
                *into += others.iter().map(|other| exchange::unoccluded(one, other)).sum::<f64>();
            }
        }
    });
    Ok(matrix)
}

/// Copies what is above the diagonal to below it.
fn mirror(matrix: &mut Matrix) {
    for i in 1..matrix.size() {
        for j in 0..i {
            let value = matrix.row(j)[i];
            matrix.row_mut(i)[j] = value;
        }
    }
}
