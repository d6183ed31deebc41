//! Cutting a convex polygon by a plane.

use crossbar_base::geom::polygon::clipped;
use glam::DVec3;

#[test]
fn a_square_is_clipped() {
    let points = |list: [[f64; 2]; 4]| list.map(|[x, y]| DVec3::new(x, y, 0.0));
    let square = points([[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]);
    let half = clipped(&square, |at| 1.0 - at.x);
    assert_eq!(half, points([[0.0, 0.0], [1.0, 0.0], [1.0, 2.0], [0.0, 2.0]]));
    assert!(clipped(&square, |at| at.x - 3.0).is_empty());
    assert_eq!(clipped(&square, |_| 0.0), square);
    assert_eq!(clipped(&square, |at| at.x - 2.0), [square[1], square[2]], "touched");
}
