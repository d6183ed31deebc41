//! Rows of form factors before they are completed, which do not depend on each other: they can be computed apart.

use rayon::prelude::*;
use refsim::machine::Executor;

use super::exchange::{self, QuadraturePatch};
use super::{FormFactors, Hemicube, VisibilityParameters, hemicube, visibility};
use crate::error::{InputError, ensure};
use crate::linalg::Matrix;
use crate::radiosity::Patches;
use crate::tracer::Caster;

/// Some rows of form factors, the others 0.
///
/// Of two patches the exchange, area times form factor, is that of both: it stands in the row of the first, above the
/// diagonal. Form factors of hemicubes are not symmetric and fill their rows.
#[derive(Clone, Debug, PartialEq)]
pub struct FormFactorRows {
    matrix: Matrix,
    are_exchanges: bool,
}

impl FormFactorRows {
    /// Computes the rows of some patches as [`FormFactors::unoccluded`] does.
    ///
    /// # Errors
    /// Those of [`FormFactors::unoccluded`].
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
        Ok(Self { matrix, are_exchanges: true })
    }

    /// Computes the rows of some patches as [`FormFactors::with_visibility`] does.
    ///
    /// # Errors
    /// Those of [`FormFactors::with_visibility`].
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

    /// Computes the rows of some patches as [`FormFactors::hemicube`] does.
    ///
    /// # Errors
    /// Those of [`FormFactors::hemicube`].
    pub fn hemicube(
        patches: &Patches,
        hemicube: &Hemicube,
        executor: &Executor,
        is_wanted: &(dyn Fn(usize) -> bool + Sync),
        done: &mut dyn FnMut(usize, usize),
    ) -> Result<Self, InputError> {
        let matrix = hemicube::matrix(patches, hemicube, executor, is_wanted, done)?;
        Ok(Self { matrix, are_exchanges: false })
    }

    /// The row of a patch: of exchanges those with later patches.
    ///
    /// # Panics
    /// If there is no such patch.
    pub fn row(&self, patch: usize) -> &[f64] {
        &self.matrix.row(patch)[self.first(patch)..]
    }

    /// Sets the row of a patch to one that was computed apart.
    ///
    /// # Errors
    /// [`InputError`] if it does not have the length of [`Self::row`].
    ///
    /// # Panics
    /// If there is no such patch.
    pub fn set_row(&mut self, patch: usize, values: &[f64]) -> Result<(), InputError> {
        let first = self.first(patch);
        let row = &mut self.matrix.row_mut(patch)[first..];
        ensure!(values.len() == row.len(), "radiosity::form_factors" =>
            "expected 1 x {} values, found {}", row.len(), values.len());
        row.copy_from_slice(values);
        Ok(())
    }

    /// Column from which on a row has values.
    fn first(&self, patch: usize) -> usize {
        if self.are_exchanges { patch + 1 } else { 0 }
    }

    /// The form factors of all rows.
    ///
    /// # Errors
    /// Of hemicubes, those of [`FormFactors::from_values`].
    pub fn complete(self, patches: &Patches) -> Result<FormFactors, InputError> {
        let (areas, mut matrix) = (patches.areas(), self.matrix);
        if !self.are_exchanges {
            return FormFactors::from_values(areas, matrix);
        }
        mirror(&mut matrix);
        matrix.par_rows_mut().zip(&areas).for_each(|(row, area)| row.iter_mut().for_each(|x| *x /= area));
        Ok(FormFactors { areas, matrix })
    }
}

impl FormFactors {
    /// Computes form factors without occlusion: exact for convex rooms, and the first step for others. Reciprocal to
    /// one ULP.
    ///
    /// # Errors
    /// [`InputError`] for too many patches.
    pub fn unoccluded(patches: &Patches) -> Result<Self, InputError> {
        FormFactorRows::unoccluded(patches, &|_| true)?.complete(patches)
    }

    /// Computes form factors with occlusion: each unoccluded form factor times the weighted fraction of unoccluded
    /// sample rays. `caster` traces [`Patches::mesh`] from both sides. `done` is called with the number of pairs done
    /// and of all pairs.
    ///
    /// # Errors
    /// [`InputError`] for too many patches, no samples, or rays that the ray caster fails on.
    pub fn with_visibility(
        patches: &Patches,
        caster: &mut dyn Caster,
        parameters: VisibilityParameters,
        done: &mut dyn FnMut(usize, usize),
    ) -> Result<Self, InputError> {
        FormFactorRows::with_visibility(patches, caster, parameters, &|_| true, done)?.complete(patches)
    }

    /// Computes form factors by hemicubes at the centres of the patches, or of their largest open parts; where a centre
    /// sees nothing, at the first of nine points that does. Occluders hide what is behind them, from either side; backs
    /// receive no light. `done` is called with the number of patches done and of all patches.
    ///
    /// Rows sum to 1 in a closed room, but pairs are not reciprocal: see [`FormFactors::reciprocity_error`],
    /// [`FormFactors::enforce_reciprocity`].
    ///
    /// # Errors
    /// [`InputError`] for too many patches, a resolution that the card does not have, or a card without fragment
    /// programs.
    pub fn hemicube(
        patches: &Patches,
        hemicube: &Hemicube,
        executor: &Executor,
        done: &mut dyn FnMut(usize, usize),
    ) -> Result<Self, InputError> {
        FormFactorRows::hemicube(patches, hemicube, executor, &|_| true, done)?.complete(patches)
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
