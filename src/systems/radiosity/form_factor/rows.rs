//! Form factors of patches. The exchanges of pairs are computed above the diagonal, mirrored, and divided by areas.

use rayon::prelude::*;

use super::exchange::{self, QuadraturePatch};
use super::{FormFactors, VisibilityParameters, visibility};
use crate::error::InputError;
use crate::linalg::Matrix;
use crate::radiosity::Patches;
use crate::tracer::Caster;

/// Exchanges without occlusion: area times form factor, which is symmetric. Each pair is in its first patch's row.
fn exchanges(patches: &Patches) -> Result<Matrix, InputError> {
    let parts = |i| patches.open_parts(i).iter().map(QuadraturePatch::new).collect();
    let list: Vec<Vec<QuadraturePatch<'_>>> = (0..patches.list().len()).map(parts).collect();
    let mut matrix = Matrix::zeros([list.len(); 2]).map_err(|error| error.coded("radiosity::form_factors"))?;
    matrix.par_rows_mut().enumerate().for_each(|(i, row)| {
        for (into, others) in row.iter_mut().zip(&list).skip(i + 1) {
            for one in &list[i] {
                *into += others.iter().map(|other| exchange::unoccluded(one, other)).sum::<f64>();
            }
        }
    });
    Ok(matrix)
}

fn complete(mut matrix: Matrix, patches: &Patches) -> FormFactors {
    let areas = patches.areas();
    divide(&mut matrix, &areas);
    FormFactors { areas, matrix }
}

impl FormFactors {
    /// Computes form factors without occlusion: exact for convex rooms, and the first step for others. They are
    /// reciprocal to one ULP. Fails with [`InputError`] for too many patches.
    pub fn unoccluded(patches: &Patches) -> Result<Self, InputError> {
        Ok(complete(exchanges(patches)?, patches))
    }

    /// Computes form factors with occlusion: each unoccluded form factor times the weighted fraction of unoccluded
    /// sample rays. `caster` traces [`Patches::mesh`] from both sides. `done` is called with the number of finished
    /// pairs and of all pairs.
    pub fn with_visibility(
        patches: &Patches,
        caster: &mut dyn Caster,
        parameters: VisibilityParameters,
        done: &mut dyn FnMut(usize, usize),
    ) -> Result<Self, InputError> {
        let mut matrix = exchanges(patches)?;
        visibility::hide(patches, &mut matrix, caster, parameters, done)?;
        Ok(complete(matrix, patches))
    }
}

/// Turns exchanges in the upper triangle into form factors: mirrors them into the lower, and divides rows by areas.
pub(super) fn divide(matrix: &mut Matrix, areas: &[f64]) {
    for i in 1..matrix.row_count() {
        for j in 0..i {
            let value = matrix.row(j)[i];
            matrix.row_mut(i)[j] = value;
        }
    }
    matrix.par_rows_mut().zip(areas).for_each(|(row, area)| row.iter_mut().for_each(|x| *x /= area));
}
