//! Set-up of a clipped triangle as a triangle fan.

use super::clip::{ClipVertex, Polygon};
use super::state::{RasterRules, RasterState};
use super::triangle::{Dropped, SetupReport, TriangleSetup, prepare};
use super::window::{Corner, doubled_area, to_window};

/// Sets up a clipped polygon as a fan around its first corner.
///
/// Snapping the clipper's corners to the grid can invert a thin polygon, which would then cover pixels of its
/// neighbour. Therefore corners beyond an edge of the triangle are dropped, as are triangles of the fan with the
/// opposite winding. The lost area is within the snapping error.
pub(super) fn clipped_setup(
    polygon: &Polygon,
    state: &RasterState,
    rules: &RasterRules,
    out: &mut Vec<TriangleSetup>,
) -> SetupReport {
    let snapped = |v: &ClipVertex| Some((*v, to_window(v.position, state, rules)?));
    let Some(corners) = polygon.corners().iter().map(snapped).collect::<Option<Vec<_>>>() else {
        return SetupReport { emitted: 0, dropped: Some(Dropped::NotFinite) };
    };
    let (winding, corners) = unfolded(&corners);
    let (mut emitted, mut why) = (0, if polygon.corners().is_empty() { Dropped::Clipped } else { Dropped::Degenerate });
    for pair in corners.get(1..).unwrap_or(&[]).windows(2) {
        let part = [corners[0], pair[0], pair[1]];
        // Snapping to the subpixel grid can invert a sliver of the fan, which would then be filled twice.
        if doubled_area(part.map(|(_, corner)| corner)).signum() != winding {
            continue;
        }
        match prepare(&part.map(|(vertex, _)| vertex), part.map(|(_, corner)| corner), state, rules) {
            Ok(done) => {
                out.push(done);
                emitted += 1;
            }
            Err(reason) => why = reason,
        }
    }
    SetupReport { emitted, dropped: (emitted == 0).then_some(why) }
}

/// Winding of a snapped polygon (the sign of its area), and its corners inside all edges of the original triangle.
/// Neighbours snap a common edge identically, so each keeps only corners on its own side.
fn unfolded(corners: &[(ClipVertex, Corner)]) -> (i64, Vec<(ClipVertex, Corner)>) {
    let around = |i: usize| (corners[i].1, corners[(i + 1) % corners.len()].1);
    let part = |i: usize| doubled_area([corners[0].1, around(i).0, around(i).1]);
    let winding = (0..corners.len()).map(part).sum::<i64>().signum();
    let is_within = |corner: Corner| {
        (0..corners.len()).filter(|&i| corners[i].0.begins_edge).all(|i| {
            let (from, to) = around(i);
            doubled_area([from, to, corner]) * winding >= 0
        })
    };
    (winding, corners.iter().copied().filter(|&(_, corner)| is_within(corner)).collect())
}
