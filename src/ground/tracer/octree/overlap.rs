//! Triangle-box overlap by the separating axis theorem (13 axes).

use glam::DVec3;

/// Returns `true` if the triangle, with corners relative to the center of the box, touches the closed box of these half
/// sides. Rounding can make it accept a triangle that misses by less than 1e-14 of the corners' magnitude, and reject a
/// triangle that overlaps by less, so callers grow the box.
pub(super) fn touches(corners: &[DVec3; 3], half: DVec3) -> bool {
    let [a, b, c] = *corners;
    for axis in 0..3 {
        let (low, high) = (a[axis].min(b[axis]).min(c[axis]), a[axis].max(b[axis]).max(c[axis]));
        if low > half[axis] || high < -half[axis] {
            return false;
        }
    }
    let edges = [b - a, c - b, a - c];
    if separates(edges[0].cross(edges[1]), corners, half) {
        return false;
    }
    for edge in edges {
        for axis in 0..3 {
            if separates_across(axis, edge, corners, half) {
                return false;
            }
        }
    }
    true
}

/// Returns `true` if a plane perpendicular to this direction separates box and triangle; `false` for a zero direction.
fn separates(direction: DVec3, corners: &[DVec3; 3], half: DVec3) -> bool {
    let [a, b, c] = corners;
    apart(a.dot(direction), b.dot(direction), c.dot(direction), half.dot(direction.abs()))
}

/// Like [`separates`], for the cross product of an edge and an axis; one component of the product is 0, the others are
/// components of the edge.
#[inline]
fn separates_across(axis: usize, edge: DVec3, corners: &[DVec3; 3], half: DVec3) -> bool {
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let (du, dv) = (-edge[v], edge[u]);
    let [a, b, c] = corners;
    let reach = half[u] * du.abs() + half[v] * dv.abs();
    apart(a[u] * du + a[v] * dv, b[u] * du + b[v] * dv, c[u] * du + c[v] * dv, reach)
}

/// Returns `true` if three numbers all lie beyond `reach` on one side.
#[inline]
fn apart(p: f64, q: f64, r: f64, reach: f64) -> bool {
    (p > reach && q > reach && r > reach) || (p < -reach && q < -reach && r < -reach)
}
