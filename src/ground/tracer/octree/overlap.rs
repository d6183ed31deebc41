//! Triangle-box overlap by the separating axis theorem (13 axes).

use glam::DVec3;

/// Returns `true` if the triangle, its corners given relative to the center of the box, touches the closed box of these
/// half sides. Rounding can make it accept a triangle that misses by less than 1e-14 of the corners' magnitude, and
/// reject one that overlaps by less: callers grow the box.
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

/// Like [`separates`], for the cross product of an edge and an axis: one of its components is 0, the others are the
/// edge's.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns `true` if a triangle touches the cube from -1 to 1.
    fn touches_cube(corners: [[f64; 3]; 3]) -> bool {
        touches(&corners.map(DVec3::from), DVec3::ONE)
    }

    #[test]
    fn a_triangle_that_holds_the_box_in_its_plane_touches() {
        assert!(touches_cube([[-9.0, -9.0, 0.5], [9.0, -9.0, 0.5], [0.0, 9.0, 0.5]]));
        assert!(touches_cube([[-9.0, -9.0, 1.0], [9.0, -9.0, 1.0], [0.0, 9.0, 1.0]]), "in the plane of a side");
        assert!(!touches_cube([[-9.0, -9.0, 1.1], [9.0, -9.0, 1.1], [0.0, 9.0, 1.1]]));
    }

    #[test]
    fn only_an_edge_direction_separates_a_corner_that_is_cut_past() {
        // The plane x + y = 2.2, far away in z: its bounding box meets the cube, it does not.
        let past = |s: f64| [[s, 0.0, -5.0], [0.0, s, -5.0], [s, 0.0, 5.0]];
        assert!(!touches_cube(past(2.2)));
        assert!(touches_cube(past(1.9)));
    }

    #[test]
    fn points_and_needles_are_triangles_too() {
        let point = |x: f64| [[x, 0.0, 0.0]; 3];
        assert!(touches_cube(point(1.0)) && !touches_cube(point(1.0 + 1e-9)));
        assert!(touches_cube([[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [3.0, 0.0, 0.0]]), "a needle through the box");
    }
}
