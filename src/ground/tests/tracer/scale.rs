use crossbar_ground::tracer::scale::{ceil_power_of_two, normalize_range, scale_into};
use glam::DVec3;

#[test]
fn ranges_are_powers_of_two() {
    assert_eq!(ceil_power_of_two(5.0), 8.0, "rounds up");
    assert_eq!(ceil_power_of_two(0.25), 0.25, "exact powers stay");
    assert_eq!(scale_into(5.0, 8.0), 1.0, "5 fits 8 as it is");
    assert_eq!(scale_into(17.0, 8.0), 0.25, "17 / 4 fits 8, 17 / 2 does not");
    let (d, power) = normalize_range([0.0, -3.0, 1.0]);
    assert_eq!((d, power), (DVec3::new(0.0, -0.75, 0.25), 0.25), "largest component in [1/2, 1)");
    let (d, _) = normalize_range([f32::from_bits(1), 0.0, 0.0]);
    assert_eq!(d.x, 0.5, "denormal f32 directions too");
}
