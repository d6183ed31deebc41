//! Polygons cut into triangles by exact tests, and convex polygons cut by a plane ([`clipped`]).
//!
//! A polygon is projected along the axis of the largest component of its normal, which drops one coordinate and rounds
//! nothing. If the fan around the first corner covers the polygon, it is the result; otherwise ears are cut off until
//! one triangle is left. Either way a polygon of n corners gives n - 2 triangles. A point inside a polygon without a
//! [`PolygonFault`] lies in exactly one triangle, or on edges of triangles.

use std::cmp::Ordering;

use glam::DVec3;
use thiserror::Error;

use super::exact::winding;
use super::vector::{place_bits, unit, wide};

/// Largest number of corners of a non-convex polygon: the time grows with the square of their number.
pub const MAX_CORNERS: usize = 4096;
/// Largest distance between corners along the normal of a flat polygon, relative to the polygon's size.
const FLATNESS: f64 = 1e-4;
/// Largest distance along the normal, relative to the largest coordinate, for the rounding to f32.
const ROUNDING: f64 = 1.0 / (1 << 21) as f64;

/// The reason why a polygon of at least four corners has no certain interior.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Error)]
pub enum PolygonFault {
    /// The corners do not lie in one plane.
    #[error("not flat")]
    Bent,
    /// Two corners have the same position.
    #[error("with two corners at one position")]
    Repeated,
    /// Two edges cross or touch.
    #[error("of edges that cross or touch")]
    Crossing,
    /// The polygon is not convex and has more than [`MAX_CORNERS`] corners, so that its edges are not compared.
    #[error("not convex and of more than {MAX_CORNERS} corners")]
    TooLong,
}

/// Cuts a polygon with finite corners into triangles, given as indices of its corners, with the polygon's winding.
///
/// ```
/// # extern crate crossbar_base as crossbar;
/// use crossbar::geom::polygon::triangulate;
///
/// // The corner at the origin is reflex: the fan around the first corner would leave the polygon.
/// let arrow = [[2.0, -1.0, 0.0], [0.0, 3.0, 0.0], [-2.0, -1.0, 0.0], [0.0, 0.0, 0.0]];
/// assert_eq!(triangulate(&arrow), (vec![[3, 0, 1], [1, 2, 3]], None));
/// ```
pub fn triangulate(outline: &[[f32; 3]]) -> (Vec<[usize; 3]>, Option<PolygonFault>) {
    let fan: Vec<[usize; 3]> = (2..outline.len()).map(|last| [0, last - 1, last]).collect();
    if fan.len() < 2 {
        return (fan, None);
    }
    let flat = projection(outline);
    let convex = flat.as_deref().is_some_and(is_convex);
    let is_long = outline.len() > MAX_CORNERS;
    let fault = if !convex && repeats(outline) {
        Some(PolygonFault::Repeated)
    } else if is_bent(outline) {
        Some(PolygonFault::Bent)
    } else if convex {
        None
    } else if is_long {
        Some(PolygonFault::TooLong)
    } else {
        flat.as_deref().is_none_or(touches_itself).then_some(PolygonFault::Crossing)
    };
    let fits = |flat: &[[f32; 2]]| fan.iter().all(|&triangle| turn(flat, triangle) != Ordering::Less);
    let clipped = match flat {
        Some(flat) if !is_long && fault != Some(PolygonFault::Crossing) && !fits(&flat) => clip_ears(&flat),
        _ => None,
    };
    (clipped.unwrap_or(fan), fault)
}

/// The part of a convex polygon where a linear function is not negative.
pub fn clipped(corners: &[DVec3], height: impl Fn(DVec3) -> f64) -> Vec<DVec3> {
    let mut kept = Vec::with_capacity(corners.len() + 1);
    kept.extend(clipped_corners(corners, height));
    kept
}

/// The corners of [`clipped`], without memory of their own.
pub fn clipped_corners(corners: &[DVec3], height: impl Fn(DVec3) -> f64) -> impl Iterator<Item = DVec3> {
    corners.iter().zip(corners.iter().cycle().skip(1)).flat_map(move |(&here, &next)| {
        let (h, k) = (height(here), height(next));
        let cut = ((h > 0.0 && k < 0.0) || (h < 0.0 && k > 0.0)).then(|| here + h / (h - k) * (next - here));
        (h >= 0.0).then_some(here).into_iter().chain(cut)
    })
}

/// Normal with twice the area as length: the sum of cross products of successive corners relative to the first.
fn normal(outline: &[[f32; 3]]) -> DVec3 {
    let first = wide(outline[0]);
    outline.windows(2).map(|pair| (wide(pair[0]) - first).cross(wide(pair[1]) - first)).fold(DVec3::ZERO, |a, b| a + b)
}

/// The corners projected along a coordinate axis, counter-clockwise; `None` if the area is zero along every axis.
fn projection(outline: &[[f32; 3]]) -> Option<Vec<[f32; 2]>> {
    let size = normal(outline).abs().to_array();
    let mut axes = [0, 1, 2];
    axes.sort_by(|&a, &b| size[b].total_cmp(&size[a]));
    axes.into_iter().find_map(|axis| {
        let along = |u: usize, v: usize| outline.iter().map(|p| [p[u], p[v]]).collect::<Vec<_>>();
        let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
        let seen = along(u, v);
        match winding(&seen) {
            Ordering::Greater => Some(seen),
            Ordering::Less => Some(along(v, u)),
            Ordering::Equal => None,
        }
    })
}

fn turn(flat: &[[f32; 2]], triangle: [usize; 3]) -> Ordering {
    winding(&triangle.map(|corner| flat[corner % flat.len()]))
}

/// Returns `true` if all corners are strictly convex and the outline goes round exactly once.
fn is_convex(flat: &[[f32; 2]]) -> bool {
    let at = |corner: usize| flat[corner % flat.len()];
    // An outline that goes round once changes between left and right twice.
    let changes = (0..flat.len()).filter(|&i| (at(i) < at(i + 1)) != (at(i + 1) < at(i + 2))).count();
    changes == 2 && (0..flat.len()).all(|i| turn(flat, [i, i + 1, i + 2]) == Ordering::Greater)
}

fn repeats(outline: &[[f32; 3]]) -> bool {
    let mut places: Vec<[u32; 3]> = outline.iter().map(|&corner| place_bits(corner)).collect();
    places.sort_unstable();
    places.windows(2).any(|pair| pair[0] == pair[1])
}

/// Returns `true` if two edges meet anywhere but at the common corner of successive edges.
fn touches_itself(flat: &[[f32; 2]]) -> bool {
    let n = flat.len();
    let at = |corner: usize| flat[corner % n];
    let folds =
        |i: usize| turn(flat, [i, i + 1, i + 2]) == Ordering::Equal && (at(i) < at(i + 1)) == (at(i + 2) < at(i + 1));
    // Successive edges share a corner.
    let meets = |i: usize| (i + 2..n).any(|j| (i, j) != (0, n - 1) && meet([at(i), at(i + 1)], [at(j), at(j + 1)]));
    (0..n).any(|i| folds(i) || meets(i))
}

fn meet(a: [[f32; 2]; 2], b: [[f32; 2]; 2]) -> bool {
    let near = |axis: usize| {
        let [[a, c], [b, d]] = [a, b].map(|edge| edge.map(|end| end[axis]));
        a.min(c) <= b.max(d) && b.min(d) <= a.max(c)
    };
    let parted = |[from, to]: [[f32; 2]; 2], ends: [[f32; 2]; 2]| {
        let [one, other] = ends.map(|end| winding(&[from, to, end]));
        one != other || one == Ordering::Equal
    };
    near(0) && near(1) && parted(a, b) && parted(b, a)
}

fn is_bent(outline: &[[f32; 3]]) -> bool {
    let (Some(normal), first) = (unit(normal(outline)), wide(outline[0])) else { return false };
    let (mut low, mut high, mut size, mut largest) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0_f64);
    for &corner in outline {
        let from_first = wide(corner) - first;
        let height = from_first.dot(normal);
        (low, high) = (low.min(height), high.max(height));
        (size, largest) = (size.max(from_first.length()), largest.max(wide(corner).abs().max_element()));
    }
    high - low > FLATNESS * size + ROUNDING * largest
}

/// Cuts off ears; `None` if no ear is left, which only happens if the outline touches itself.
fn clip_ears(flat: &[[f32; 2]]) -> Option<Vec<[usize; 3]>> {
    let mut left: Vec<usize> = (0..flat.len()).collect();
    let mut triangles = Vec::with_capacity(left.len() - 2);
    let mut start = 0;
    while left.len() > 3 {
        let n = left.len();
        let ear = |i: usize| [left[(i + n - 1) % n], left[i % n], left[(i + 1) % n]];
        let mut tips = start..start + n;
        // Where corners are repeated, triangles without area may have to go first.
        let tip = tips.clone().find(|&i| is_ear(flat, &left, ear(i)));
        let tip = tip.or_else(|| tips.find(|&i| turn(flat, ear(i)) == Ordering::Equal))?;
        triangles.push(ear(tip));
        left.remove(tip % n);
        // The next search continues here, so that it seldom tests failed corners again.
        start = tip % n;
    }
    let last = [left[0], left[1], left[2]];
    triangles.push(last);
    (turn(flat, last) != Ordering::Less).then_some(triangles)
}

/// Returns `true` if a corner is convex and no other corner lies in its triangle. This alone ensures a triangulation
/// without overlap: each triangle has the polygon's winding, and the signed areas add up to the polygon's.
fn is_ear(flat: &[[f32; 2]], left: &[usize], ear: [usize; 3]) -> bool {
    let corners = ear.map(|corner| flat[corner]);
    let [a, b, c] = corners;
    let outside = |p: [f32; 2]| {
        let beyond = |axis: usize| {
            let [a, b, c] = corners.map(|corner| corner[axis]);
            p[axis] < a.min(b).min(c) || p[axis] > a.max(b).max(c)
        };
        beyond(0) || beyond(1) || [[a, b, p], [b, c, p], [c, a, p]].iter().any(|side| winding(side) == Ordering::Less)
    };
    winding(&corners) == Ordering::Greater
        && left.iter().map(|&corner| flat[corner]).all(|p| corners.contains(&p) || outside(p))
}
