use crossbar_base::geom::UnitFrame;
use glam::DVec3;

#[test]
fn the_unit_is_a_power_of_two_above() {
    for (half_diagonal, unit) in [(0.0, 1.0), (1.0, 2.0), (1.5, 2.0), (2.0, 4.0), (0.3, 0.5)] {
        assert_eq!(UnitFrame::new([DVec3::ZERO, 2.0 * half_diagonal * DVec3::Y]).unit(), unit);
    }
    let frame = UnitFrame::new([DVec3::ZERO, DVec3::new(6.0, 0.0, 0.0), DVec3::new(3.0, 1.0, 8.0)]);
    assert_eq!((frame.unit(), frame.of_scene(DVec3::new(3.0, 0.5, 12.0))), (8.0, DVec3::Z));
    assert_eq!(UnitFrame::new([]).of_scene(DVec3::X), DVec3::X);
}
