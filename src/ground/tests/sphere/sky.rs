use crossbar_ground::sphere::{ClearSky, DirectionRule, SUN_RADIUS};
use glam::DVec3;
use std::f64::consts::PI;

const SKY: ClearSky =
    ClearSky { sun: DVec3::new(1.0, 2.0, 2.0), sun_radiance: [0.0; 3], zenith: [1.0; 3], ground: [0.0; 3] };

#[test]
fn the_zenith_is_1_and_the_sun_is_bright() {
    let at = |v: DVec3| SKY.relative(v.normalize()).expect("a sky");
    assert_eq!(at(DVec3::Z), 1.0);
    assert!(at(SKY.sun) > 4.0 && at(DVec3::new(-1.0, -2.0, 2.0)) < 1.0);
}

#[test]
fn a_finer_rule_changes_little() {
    let sky = SKY.light(10).expect("a sky");
    let finer = DirectionRule::hemisphere(511).project(10, |v| SKY.relative(v).expect("a sky"));
    let most = sky.channels()[0].iter().zip(&finer).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
    assert!(most < 1e-5 * finer[0], "{most:e} of {}", finer[0]);
}

#[test]
fn sun_and_ground_are_added() {
    let bright = ClearSky { sun_radiance: [1e4; 3], ground: [0.5; 3], ..SKY };
    let [with, without] = [bright, SKY].map(|sky| sky.light(1).expect("a sky").channels()[0][0]);
    let added = (with - without) * (4.0 * PI).sqrt();
    let expected = 1e4 * PI * SUN_RADIUS * SUN_RADIUS + 0.5 * 2.0 * PI;
    assert!((added / expected - 1.0).abs() < 1e-5, "{added} {expected}");
    let night = ClearSky { sun: -DVec3::Z, ..SKY };
    let found = night.light(3).unwrap_err().to_string();
    assert_eq!(found, "expected a sun above the horizon, z > 0, found [-0, -0, -1]");
}
