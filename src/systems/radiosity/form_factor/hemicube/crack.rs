//! Cracks: pixels that show nothing, or the inside of a solid, although the center of the pixel sees a front.
//!
//! Where the patches of one face end in the middle of a patch of the next, snapping to the raster's grid opens cracks
//! of a sixteenth of a pixel. For a pixel whose center falls into one, the geometry is ray cast; a real opening stays
//! one.

use super::item::HemicubeView;
use crate::radiosity::draw::Projection;
use crate::radiosity::{Patch, Patches};
use glam::DVec3;

/// Relative distance outside a side of a patch at which a ray may pass and still hit the patch: neighbours' corners
/// agree in f32.
const SLACK: f64 = 1e-6;

/// Fills the cracks of a face of `width` pixels per row; returns their number.
pub(super) fn fill(patches: &Patches, eye: &HemicubeView, face: &Projection, width: usize, codes: &mut [f32]) -> usize {
    let height = codes.len() / width;
    let cracks: Vec<usize> =
        (0..codes.len()).filter(|&at| codes[at] <= 0.0 && is_edge(codes, width, height, at)).collect();
    let mut filled = 0;
    for at in cracks {
        let center = [(at % width, width), (at / width, height)].map(|(i, n)| (2 * i + 1) as f64 / n as f64 - 1.0);
        let found = nearest(patches, eye, face, direction(face, [center[0], -center[1]]));
        codes[at] = found as f32;
        filled += usize::from(found > 0.0);
    }
    filled
}

/// Returns `true` if a pixel lies at the face's border or beside one that shows a front.
fn is_edge(codes: &[f32], width: usize, height: usize, at: usize) -> bool {
    let (x, y) = (at % width, at / width);
    if x == 0 || y == 0 || x + 1 == width || y + 1 == height {
        return true;
    }
    (y - 1..=y + 1).any(|y| codes[y * width + x - 1..=y * width + x + 1].iter().any(|&code| code > 0.0))
}

/// The direction whose clip coordinates are x, y and 1. The axes are those of a hemicube: orthonormal, except for
/// `upwards` of a side, which is twice the normal less `forward`.
fn direction(face: &Projection, [x, y]: [f64; 2]) -> DVec3 {
    let leaning = face.upwards.dot(face.forward);
    let up = face.upwards - leaning * face.forward;
    let height = (y - leaning) / up.dot(up);
    face.forward + x * face.across + height * up
}

/// Color of the nearest patch along a ray from the eye; 0 for none.
fn nearest(patches: &Patches, eye: &HemicubeView, face: &Projection, direction: DVec3) -> f64 {
    let (mut best, mut first) = (0.0, f64::INFINITY);
    for &(i, code) in &eye.seen {
        let patch = &patches.list()[i as usize];
        let (height, fall) = (patch.height(face.eye), patch.normal().dot(direction));
        let t = -height / fall;
        if t > 0.0 && t < first && holds(patch, face.eye + t * direction) {
            (best, first) = (code, t);
        }
    }
    best
}

/// Returns `true` if a point of a patch's plane is in the patch, or within [`SLACK`] of it.
fn holds(patch: &Patch, point: DVec3) -> bool {
    let corners = patch.corners();
    (0..corners.len()).all(|i| {
        let side = corners[(i + 1) % corners.len()] - corners[i];
        side.cross(point - corners[i]).dot(patch.normal()) >= -SLACK * side.dot(side)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::radiosity::{Subdivision, rooms};
    use approx::abs_diff_eq;

    #[test]
    fn a_direction_goes_through_its_pixel() {
        let patches = Patches::new(&rooms::furnace(0.5), Subdivision::PerSide(2)).expect("patches");
        let patch = &patches.list()[5];
        let eye = HemicubeView::new(&patches, patch, patch.center());
        for face in &eye.faces {
            for [x, y] in [[0.3, -0.7], [-1.0, 1.0], [0.0, 0.25]] {
                let d = direction(face, [x, y]);
                let found = [face.across, face.upwards, face.forward].map(|axis| axis.dot(d));
                assert!(
                    found.into_iter().zip([x, y, 1.0]).all(|(a, b)| abs_diff_eq!(a, b, epsilon = 1e-12)),
                    "{found:?}"
                );
            }
        }
    }

    #[test]
    fn cracks_are_filled_with_what_is_there() {
        let patches = Patches::new(&rooms::furnace(0.5), Subdivision::PerSide(2)).expect("patches");
        let patch = &patches.list()[0];
        let eye = HemicubeView::new(&patches, patch, patch.center());
        let ceiling = |code: f32| patches.list()[code as usize - 1].face == 1;
        let mut codes = vec![0.0; 25];
        codes[12] = 9.0;
        // All pixels beside the middle or at the border, which are all.
        assert_eq!(fill(&patches, &eye, &eye.faces[0], 5, &mut codes), 24);
        assert!(codes.iter().all(|&code| code > 0.0) && ceiling(codes[13]));
    }
}
