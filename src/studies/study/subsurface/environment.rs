//! Light of an environment map at the texels of the atlas.

use glam::DVec3;

use super::Parameters;
use crate::atlas::Atlas;
use crate::geom::Sides;
use crate::study::StudyError;
use crate::study::caster::CastRecord;
use crate::subsurface::{DistantSource, distant_irradiance};
use crate::transfer::grid::{LIGHT_MAP, LIGHT_SIDE};
use crate::transfer::light::CubeLight;

/// Side, in texels of the light, of the square that one shadow ray of the study represents.
const GROUP: usize = 2;

/// E of equation 8 per texel of the atlas, with the model's own shadows; and the Ray Engine's statistics, if any.
pub(super) fn irradiance(
    atlas: &Atlas,
    parameters: &Parameters,
    light: &CubeLight,
) -> Result<(Vec<[f64; 3]>, Option<CastRecord>), StudyError> {
    let mut caster = parameters.caster.open_judged(&parameters.mesh, Sides::Both)?;
    let found = distant_irradiance(atlas, &sources(light, GROUP), parameters.material.eta, &mut caster);
    let found = found.map_err(|error| StudyError::coded("subsurface::shadows", error))?;
    Ok((found, caster.record()))
}

/// The light as parallel beams, one per `group` x `group` texels that are not all dark, from their mean direction.
pub(in crate::study) fn sources(light: &CubeLight, group: usize) -> Vec<DistantSource> {
    let source = |face: usize, row: usize, column: usize| {
        let (mut sum, mut towards) = (DVec3::ZERO, DVec3::ZERO);
        for (row, column) in (0..group * group).map(|k| (row + k / group, column + k % group)) {
            let radiance = DVec3::from(light.texels()[(face * LIGHT_SIDE + row) * LIGHT_SIDE + column]);
            let irradiance = radiance * LIGHT_MAP.solid_angle(column, row);
            sum += irradiance;
            towards += irradiance.element_sum() * LIGHT_MAP.direction(face, column, row);
        }
        Some(DistantSource { towards: towards.try_normalize()?, irradiance: sum.to_array() })
    };
    let groups = LIGHT_SIDE / group;
    let places = (0..6 * groups * groups).map(|k| (k / (groups * groups), k / groups % groups, k % groups));
    places.filter_map(|(face, row, column)| source(face, group * row, group * column)).collect()
}
