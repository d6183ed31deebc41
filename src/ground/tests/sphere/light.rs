use crossbar_ground::sphere::HarmonicLight;
use glam::DVec3;

#[test]
fn what_is_no_light_is_refused() {
    let disk = |direction, radius, color| HarmonicLight::disk(3, direction, radius, color).expect_err("refused");
    assert!(
        disk(DVec3::ZERO, 1.0, [1.0; 3]).to_string().contains("expected a direction of finite length above 0, found ")
    );
    assert!(
        disk(DVec3::NAN, 1.0, [1.0; 3]).to_string().contains("expected a direction of finite length above 0, found ")
    );
    for radius in [0.0, 3.2, f64::NAN] {
        assert!(
            disk(DVec3::Z, radius, [1.0; 3])
                .to_string()
                .contains("expected an angular radius above 0 and up to pi radians, found ")
        );
    }
    assert!(disk(DVec3::Z, 1.0, [f64::NAN; 3]).to_string().contains("expected finite red, green and blue, found "));
    let ragged = HarmonicLight::new([vec![0.0; 4], vec![0.0; 4], vec![0.0; 9]]);
    let error = ragged.expect_err("refused").to_string();
    assert_eq!(error, "expected n^2 coefficients in each of three channels, n from 1 to 10, found [4, 4, 9]");
}

#[test]
fn the_light_of_figure_7_is_red_on_one_side_and_blue_on_the_other() {
    let light = HarmonicLight::red_and_blue(5);
    let [right, left] = [1.0, -1.0].map(|x| light.radiance(DVec3::new(0.8 * x, 0.6, 0.0)));
    assert!(right[0] > 2.0 * right[2] && left[2] > 2.0 * left[0], "{right:?} {left:?}");
}
