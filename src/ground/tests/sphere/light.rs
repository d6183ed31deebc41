use crossbar_ground::sphere::HarmonicLight;
use glam::DVec3;

#[test]
fn what_is_no_light_is_refused() {
    let disk = |direction, radius, color| HarmonicLight::disk(3, direction, radius, color).is_err();
    assert!(disk(DVec3::ZERO, 1.0, [1.0; 3]) && disk(DVec3::NAN, 1.0, [1.0; 3]) && disk(DVec3::Z, 1.0, [f64::NAN; 3]));
    assert!([0.0, 3.2, f64::NAN].iter().all(|&radius| disk(DVec3::Z, radius, [1.0; 3])));
    assert!(HarmonicLight::new([vec![0.0; 4], vec![0.0; 4], vec![0.0; 9]]).is_err());
}

#[test]
fn the_light_of_figure_7_is_red_on_one_side_and_blue_on_the_other() {
    let light = HarmonicLight::red_and_blue(5);
    let [right, left] = [1.0, -1.0].map(|x| light.radiance(DVec3::new(0.8 * x, 0.6, 0.0)));
    assert!(right[0] > 2.0 * right[2] && left[2] > 2.0 * left[0], "{right:?} {left:?}");
}
