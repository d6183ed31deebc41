//! Incomplete rows of form factors, which are independent of each other, so that separate runs can compute them.

use rayon::prelude::*;

use super::exchange::{self, QuadraturePatch};
use super::{FormFactors, VisibilityParameters, visibility};
use crate::error::{InputError, ensure};
use crate::linalg::Matrix;
use crate::radiosity::Patches;
use crate::tracer::Caster;

/// Some rows of form factors; the others are 0.
///
/// The exchange of two patches, area times form factor, is symmetric: it is stored in the row of the first patch, above
/// the diagonal.
#[derive(Clone, Debug, PartialEq)]
pub struct FormFactorRows {
    matrix: Matrix,
}

impl FormFactorRows {
    /// Computes the rows of some patches. Fails as [`FormFactors::unoccluded`] does.
    pub fn unoccluded(patches: &Patches, is_wanted: &(dyn Fn(usize) -> bool + Sync)) -> Result<Self, InputError> {
        let parts = |i| patches.open_parts(i).iter().map(QuadraturePatch::new).collect();
        let list: Vec<Vec<QuadraturePatch<'_>>> = (0..patches.list().len()).map(parts).collect();
        let matrix = Matrix::zeros([list.len(); 2]);
        let mut matrix = matrix.map_err(|error| error.coded("radiosity::form_factors"))?;
        matrix.par_rows_mut().enumerate().filter(|(i, _)| is_wanted(*i)).for_each(|(i, row)| {
            for (into, others) in row.iter_mut().zip(&list).skip(i + 1) {
                for one in &list[i] {
                    *into += others.iter().map(|other| exchange::unoccluded(one, other)).sum::<f64>();
                }
            }
        });
        Ok(Self { matrix })
    }

    /// Computes the rows of some patches with occlusion. Fails as [`FormFactors::with_visibility`] does.
    pub fn with_visibility(
        patches: &Patches,
        caster: &mut dyn Caster,
        parameters: VisibilityParameters,
        is_wanted: &(dyn Fn(usize) -> bool + Sync),
        done: &mut dyn FnMut(usize, usize),
    ) -> Result<Self, InputError> {
        let mut rows = Self::unoccluded(patches, is_wanted)?;
        visibility::hide(patches, &mut rows.matrix, caster, parameters, done)?;
        Ok(rows)
    }

    /// The exchanges of a patch with all patches of higher index. Panics if there is no such patch.
    pub fn row(&self, patch: usize) -> &[f64] {
        &self.matrix.row(patch)[patch + 1..]
    }

    /// Sets the row of a patch, computed in another run. Fails with [`InputError`] if it does not have the length of
    /// [`Self::row`]. Panics if there is no such patch.
    pub fn set_row(&mut self, patch: usize, values: &[f64]) -> Result<(), InputError> {
        let row = &mut self.matrix.row_mut(patch)[patch + 1..];
        ensure!(values.len() == row.len(), "radiosity::form_factors" =>
            "expected 1 x {} values, found {}", row.len(), values.len());
        row.copy_from_slice(values);
        Ok(())
    }

    /// The form factors of all rows.
    pub fn complete(self, patches: &Patches) -> FormFactors {
        let (areas, mut matrix) = (patches.areas(), self.matrix);
        mirror(&mut matrix);
        matrix.par_rows_mut().zip(&areas).for_each(|(row, area)| row.iter_mut().for_each(|x| *x /= area));
        FormFactors { areas, matrix }
    }
}

impl FormFactors {
    /// Computes form factors without occlusion: exact for convex rooms, and the first step for others. They are
    /// reciprocal to one ULP. Fails with [`InputError`] for too many patches.
    pub fn unoccluded(patches: &Patches) -> Result<Self, InputError> {
        Ok(FormFactorRows::unoccluded(patches, &|_| true)?.complete(patches))
    }

    /// Computes form factors with occlusion: each unoccluded form factor times the weighted fraction of unoccluded
    /// sample rays. `caster` traces [`Patches::mesh`] from both sides. `done` is called with the number of finished
    /// pairs and of all pairs. Fails with [`InputError`] for too many patches or no samples, or if the ray caster
    /// fails.
    pub fn with_visibility(
        patches: &Patches,
        caster: &mut dyn Caster,
        parameters: VisibilityParameters,
        done: &mut dyn FnMut(usize, usize),
    ) -> Result<Self, InputError> {
        Ok(FormFactorRows::with_visibility(patches, caster, parameters, &|_| true, done)?.complete(patches))
    }
}

/// Copies the upper triangle to the lower one.
pub(super) fn mirror(matrix: &mut Matrix) {
    for i in 1..matrix.row_count() {
        for j in 0..i {
            let value = matrix.row(j)[i];
            matrix.row_mut(i)[j] = value;
        }
    }
}
