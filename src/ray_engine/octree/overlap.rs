//! Whether a triangle touches a closed box: no plane separates them (the separating axis theorem, 13 axes).

use crate::ray_engine::reference::{cross, dot, sub};

type Vector = [f64; 3];

/// Whether the triangle, its corners given from the middle of the box, touches the box of these half sides. Rounding can make
/// it say yes to a triangle that misses by less than 1e-14 of the corners' magnitude, and no to one that reaches in by less:
/// callers grow the box.
pub(super) fn touches(corners: &[Vector; 3], half: Vector) -> bool {
    let [a, b, c] = *corners;
    for axis in 0..3 {
        let (low, high) = (a[axis].min(b[axis]).min(c[axis]), a[axis].max(b[axis]).max(c[axis]));
        if low > half[axis] || high < -half[axis] {
            return false;
        }
    }
    let edges = [sub(b, a), sub(c, b), sub(a, c)];
    if separates(cross(edges[0], edges[1]), corners, half) {
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

/// Whether a plane across this direction has the box on one side and the triangle on the other. No direction separates nothing.
fn separates(direction: Vector, corners: &[Vector; 3], half: Vector) -> bool {
    let [dx, dy, dz] = direction;
    let reach = half[0] * dx.abs() + half[1] * dy.abs() + half[2] * dz.abs();
    let [a, b, c] = corners;
    apart(dot(*a, direction), dot(*b, direction), dot(*c, direction), reach)
}

/// The same for the direction that is across an edge and an axis: one of its components is 0, the others are the edge's.
#[inline]
fn separates_across(axis: usize, edge: Vector, corners: &[Vector; 3], half: Vector) -> bool {
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let (du, dv) = (-edge[v], edge[u]);
    let [a, b, c] = corners;
    let reach = half[u] * du.abs() + half[v] * dv.abs();
    apart(a[u] * du + a[v] * dv, b[u] * du + b[v] * dv, c[u] * du + c[v] * dv, reach)
}

/// Whether three numbers all lie beyond `reach` on one side.
#[inline]
fn apart(p: f64, q: f64, r: f64, reach: f64) -> bool {
    (p > reach && q > reach && r > reach) || (p < -reach && q < -reach && r < -reach)
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNIT: Vector = [1.0; 3];

    #[test]
    fn a_triangle_that_holds_the_box_in_its_plane_touches() {
        assert!(touches(&[[-9.0, -9.0, 0.5], [9.0, -9.0, 0.5], [0.0, 9.0, 0.5]], UNIT));
        assert!(touches(&[[-9.0, -9.0, 1.0], [9.0, -9.0, 1.0], [0.0, 9.0, 1.0]], UNIT), "in the plane of a side");
        assert!(!touches(&[[-9.0, -9.0, 1.1], [9.0, -9.0, 1.1], [0.0, 9.0, 1.1]], UNIT));
    }

    #[test]
    fn only_an_edge_direction_separates_a_corner_that_is_cut_past() {
        // The plane x + y = 2.2, far away in z: its bounding box meets the cube, it does not.
        let past = |s: f64| [[s, 0.0, -5.0], [0.0, s, -5.0], [s, 0.0, 5.0]];
        assert!(!touches(&past(2.2), UNIT));
        assert!(touches(&past(1.9), UNIT));
    }

    #[test]
    fn points_and_needles_are_triangles_too() {
        let point = |x: f64| [[x, 0.0, 0.0]; 3];
        assert!(touches(&point(1.0), UNIT) && !touches(&point(1.0 + 1e-9), UNIT));
        assert!(touches(&[[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [3.0, 0.0, 0.0]], UNIT), "a needle through the box");
    }
}
