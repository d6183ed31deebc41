use crossbar_base::geom::vector::wide;
use crossbar_ground::tracer::offset::{SINGLE, SurfacePoint};
use glam::DVec3;

#[test]
fn the_clearance_is_a_few_units_in_the_last_place() {
    let corners = [[10.0, 0.0, 3.0], [11.0, 0.5, 3.25], [10.0, 2.0, 4.0]].map(DVec3::from);
    let point = SurfacePoint::of(corners, DVec3::splat(1.0 / 3.0), SINGLE).expect("a triangle with an area");
    let clearance = point.clearance(0.0);
    assert!(clearance > 0.0 && clearance < 1e-5, "{clearance}");
    let lifted = wide(point.lifted(point.normal, 0.0));
    assert!((lifted - point.at).dot(point.normal) > clearance / 2.0, "rounding does not eat it up");
}
