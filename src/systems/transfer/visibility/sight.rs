//! Classification of a vertex's fine directions before rays are cast.

use glam::DVec3;

use super::maps::{Horizon, VisibilitySampling};
use crate::geom::vector::wide;
use crate::transfer::grid::{LIGHT_TEXELS, texel_center};
use crate::transfer::{LocalFrame, Occluders, RayOrigin, SkyPart};

/// The largest sine of the angle from a light texel's center to one of its fine directions: 3/4 of half a diagonal at
/// the middle of a face, 0.0332, rounded up.
const TEXEL_SINE: f64 = 0.034;

/// The fine directions of a vertex in which rays must be cast, and counts of the others.
#[derive(Debug, Default)]
pub(super) struct UndecidedDirections {
    pub(super) fine: Vec<u32>,
    pub(super) above: u64,
    pub(super) below_triangles: u64,
}

/// Sets the bits of directions that are certainly unblocked, and lists those that may be blocked.
pub(super) fn look(
    (frame, origin): (&LocalFrame, &RayOrigin),
    occluders: &Occluders,
    sampling: VisibilitySampling,
    waiting: &mut Vec<u32>,
    bits: &mut [u64],
) -> UndecidedDirections {
    let skyline = occluders.skyline(wide(origin.at), frame, waiting);
    let (fine_directions, normal) = (sampling.directions(), frame.normal());
    let sees_below = sampling.horizon == Horizon::Geometry;
    let mut asked = UndecidedDirections::default();
    for texel in 0..LIGHT_TEXELS {
        let center = texel_center(texel);
        let height = normal.dot(center);
        if height <= -TEXEL_SINE && !sees_below {
            continue;
        }
        let is_high = height >= TEXEL_SINE && origin.planes.iter().any(|plane| plane.dot(center) >= TEXEL_SINE);
        // The skyline does not cover directions below the plane of the normal.
        let may_be_blocked = height < TEXEL_SINE && sees_below || skyline.may_block(frame.to_local(center), TEXEL_SINE);
        for fine in fine_directions.in_texel(texel) {
            let direction = fine_directions.directions()[fine];
            let is_below = !is_high && normal.dot(direction) <= 0.0;
            if is_below && !sees_below {
                continue;
            }
            asked.above += 1;
            if !is_high && origin.is_below_horizon(direction) {
                asked.below_triangles += 1;
            } else if is_below || may_be_blocked && skyline.is_marked(SkyPart::of(frame.to_local(direction))) {
                asked.fine.push(fine as u32);
            } else {
                bits[fine / 64] |= 1 << (fine % 64);
            }
        }
    }
    asked
}

/// The fine directions above a vertex's horizons, in order, and the number of those below its triangles.
pub(super) fn above(frame: &LocalFrame, origin: &RayOrigin, sampling: VisibilitySampling) -> (Vec<u32>, u64) {
    let sees_below = sampling.horizon == Horizon::Geometry;
    let is_above = |direction: &DVec3| sees_below || frame.normal().dot(*direction) > 0.0;
    let all = (0..).zip(sampling.directions().directions()).filter(|(_, direction)| is_above(direction));
    let (below, open): (Vec<_>, Vec<_>) = all.partition(|(_, direction)| origin.is_below_horizon(**direction));
    (open.into_iter().map(|(fine, _)| fine).collect(), below.len() as u64)
}

/// Sets a bit of a map.
pub(super) fn set(bits: &mut [u64], fine: u32) {
    bits[fine as usize / 64] |= 1 << (fine % 64);
}
