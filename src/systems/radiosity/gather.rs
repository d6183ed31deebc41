//! Irradiance at points, gathered from all patches of a solution.

use super::Patches;
use super::form_factor::point_to_polygon;
use super::form_factor::{VisibilityParameters, point_share};
use crate::error::InputError;
use crate::tracer::Caster;
use glam::DVec3;

/// Computes the irradiance at a point with a unit normal: the sum over the patches of radiosity, form factor from the
/// point in closed form, and the fraction of sample rays that are unoccluded. `caster` traces [`Patches::mesh`] from
/// both sides. Panics if there is not one radiosity per patch.
pub fn irradiance(
    patches: &Patches,
    radiosity: &[[f64; 3]],
    [point, normal]: [DVec3; 2],
    caster: &mut dyn Caster,
    parameters: VisibilityParameters,
) -> Result<[f64; 3], InputError> {
    assert_eq!(patches.list().len(), radiosity.len(), "one radiosity per patch");
    let seen: Vec<(usize, f64)> = (0..patches.list().len())
        .map(|j| {
            (j, patches.open_parts(j).iter().map(|part| point_to_polygon(point, normal, part.corners())).sum::<f64>())
        })
        .filter(|&(_, factor)| factor > 0.0)
        .collect();
    let targets: Vec<usize> = seen.iter().map(|&(j, _)| j).collect();
    let shares = point_share(patches, [point, normal], &targets, caster, parameters)?;
    let mut sum = [0.0; 3];
    for ((j, factor), share) in seen.into_iter().zip(shares) {
        sum = [0, 1, 2].map(|c| sum[c] + factor * share * radiosity[j][c]);
    }
    Ok(sum)
}
