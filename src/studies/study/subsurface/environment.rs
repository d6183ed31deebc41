//! Light of an environment map at the texels of the atlas.

use glam::DVec3;

use super::Parameters;
use crate::atlas::Atlas;
use crate::geom::Sides;
use crate::study::StudyError;
use crate::subsurface::{DistantSource, distant_irradiance};
use crate::tracer::HostTracer;
use crate::transfer::grid::{LIGHT_MAP, LIGHT_SIDE};
use crate::transfer::light::CubeLight;

/// Texels of the light along a side of the square that one shadow ray represents.
const GROUP: usize = 2;

/// E of equation 8 per texel of the atlas, with the model's own shadows.
pub(super) fn irradiance(
    atlas: &Atlas,
    parameters: &Parameters,
    light: &CubeLight,
) -> Result<Vec<[f64; 3]>, StudyError> {
    let mut caster = HostTracer::new(&parameters.mesh, Sides::Both);
    let found = distant_irradiance(atlas, &sources(light), parameters.material.eta, &mut caster);
    found.map_err(|error| StudyError::coded("subsurface::shadows", error))
}

/// The light as parallel beams, one per [`GROUP`] x [`GROUP`] texels that are not dark: the sum of radiance times solid
/// angle, from its mean direction.
fn sources(light: &CubeLight) -> Vec<DistantSource> {
    let source = |face: usize, row: usize, column: usize| {
        let (mut sum, mut towards) = (DVec3::ZERO, DVec3::ZERO);
        for (row, column) in (0..GROUP * GROUP).map(|k| (row + k / GROUP, column + k % GROUP)) {
            let radiance = DVec3::from(light.texels()[(face * LIGHT_SIDE + row) * LIGHT_SIDE + column]);
            let irradiance = radiance * LIGHT_MAP.solid_angle(column, row);
            sum += irradiance;
            towards += irradiance.element_sum() * LIGHT_MAP.direction(face, column, row);
        }
        Some(DistantSource { towards: towards.try_normalize()?, irradiance: sum.to_array() })
    };
    let groups = LIGHT_SIDE / GROUP;
    let places = (0..6 * groups * groups).map(|k| (k / (groups * groups), k / groups % groups, k % groups));
    places.filter_map(|(face, row, column)| source(face, GROUP * row, GROUP * column)).collect()
}
