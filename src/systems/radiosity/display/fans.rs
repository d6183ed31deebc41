//! Patches with T-junctions on their sides, drawn as triangle fans.
//!
//! The card snaps corners to a grid of a sixteenth of a pixel. If a side were drawn as one line, cracks would open at
//! the neighbours' snapped corners on it. A patch with such a side is drawn as a fan around its centre, with a vertex
//! at each corner on its sides.

use std::collections::{BTreeMap, BTreeSet};

use super::corners::place;
use crate::geom::vector::wide;
use crate::radiosity::{Patch, Patches};
use glam::DVec3;

/// Distance at which a corner counts as on a side, relative to the scene's diagonal: the precision of f32 corners.
const ON_SIDE: f64 = 1e-6;

/// Point of a patch with its coordinates in the patch.
pub(super) type FanVertex = (DVec3, [f64; 2]);

type SnappedCorner = [u32; 3];

/// Sides of patches that are not also a full side of another patch.
fn loose_sides(patches: &Patches) -> BTreeSet<[SnappedCorner; 2]> {
    let mut count: BTreeMap<[SnappedCorner; 2], u32> = BTreeMap::new();
    for patch in patches.list() {
        for side in sides(patch) {
            *count.entry(key(side)).or_default() += 1;
        }
    }
    count.into_iter().filter(|&(_, count)| count == 1).map(|(side, _)| side).collect()
}

fn sides(patch: &Patch) -> impl Iterator<Item = [DVec3; 2]> + '_ {
    let corners = patch.corners();
    (0..corners.len()).map(|i| [corners[i], corners[(i + 1) % corners.len()]])
}

/// Key of a side, regardless of its direction.
fn key(side: [DVec3; 2]) -> [SnappedCorner; 2] {
    let mut ends = side.map(place);
    ends.sort_unstable();
    ends
}

/// Returns the fan of each patch with other patches' corners on its sides; `None` for patches that are drawn unchanged.
pub(super) fn fans(patches: &Patches) -> Vec<Option<Vec<[FanVertex; 3]>>> {
    let loose = loose_sides(patches);
    let ends: BTreeSet<SnappedCorner> = loose.iter().flatten().copied().collect();
    let ends: Vec<DVec3> = ends.into_iter().map(|end| wide(end.map(f32::from_bits))).collect();
    let near = ON_SIDE * patches.extent();
    let outline = |patch: &Patch| {
        let count = patch.corners().len();
        let (inside, mut outline) = (in_patch(patch), Vec::new());
        for (k, [a, b]) in sides(patch).enumerate() {
            let (from, to) = (inside[k], inside[(k + 1) % count]);
            outline.push((a, from));
            if loose.contains(&key([a, b])) {
                let mut on_side: Vec<(f64, DVec3)> =
                    ends.iter().filter_map(|&end| Some((share(end, [a, b], near)?, end))).collect();
                on_side.sort_unstable_by(|one, other| one.0.total_cmp(&other.0));
                let mixed = |t: f64| [0, 1].map(|axis| (1.0 - t) * from[axis] + t * to[axis]);
                outline.extend(on_side.into_iter().map(|(t, end)| (end, mixed(t))));
            }
        }
        (outline.len() > count).then(|| fan(patch, &outline))
    };
    patches.list().iter().map(outline).collect()
}

/// Returns the parameter in (0, 1) of a point on a side; `None` if the point is not on the side.
fn share(point: DVec3, [a, b]: [DVec3; 2], near: f64) -> Option<f64> {
    let (along, to) = (b - a, point - a);
    let t = to.dot(along) / along.dot(along);
    let off = (to - t * along).length();
    let margin = near / along.length();
    (off <= near && t > margin && t < 1.0 - margin).then_some(t)
}

fn fan(patch: &Patch, outline: &[FanVertex]) -> Vec<[FanVertex; 3]> {
    let corners = patch.corners();
    let shares = 1.0 / corners.len() as f64;
    let middle = shares * corners.iter().sum::<DVec3>();
    let inside = if corners.len() == 3 { [shares; 2] } else { [0.5; 2] };
    let next = |i: usize| outline[(i + 1) % outline.len()];
    (0..outline.len()).map(|i| [(middle, inside), outline[i], next(i)]).collect()
}

/// Coordinates of a patch's corners within the patch: along two sides of a quadrilateral, or the weights of a
/// triangle's second and third corner.
pub(super) fn in_patch(patch: &Patch) -> [[f64; 2]; 4] {
    let [b, c] = [[1.0, 0.0], [0.0, 1.0]];
    if patch.corners().len() == 3 { [[0.0, 0.0], b, c, c] } else { [[0.0, 0.0], b, [1.0, 1.0], c] }
}
