use approx::assert_abs_diff_eq;
use crossbar_base::geom::UnitFrame;
use crossbar_base::geom::vector::wide;
use crossbar_ground::scene::Camera;
use glam::DVec3;

#[test]
fn pixels_run_from_the_upper_left() {
    let camera = Camera::new([0.0; 3], [0.0, 3.0, 0.0], [0.0, 0.0, 1.0], 0.5, 4, 2).expect("a camera");
    assert_eq!(camera.direction(0, 0), [-0.75, 1.0, 0.25]);
    assert_eq!(camera.direction(3, 1), [0.75, 1.0, -0.25]);
    assert_eq!(camera.rays().len(), 8);
    assert_eq!(camera.rays()[5], camera.ray(1, 1));
}

#[test]
fn a_point_is_where_the_camera_sees_it() {
    let camera = Camera::new([1.0, 2.0, 3.0], [1.0, 5.0, 3.0], [0.0, 0.0, 1.0], 0.5, 4, 2).expect("a camera");
    let matrix = camera.world_to_camera();
    let seen =
        |[x, y, z]: [f32; 3]| [0, 1, 2].map(|k| x * matrix[k] + y * matrix[4 + k] + z * matrix[8 + k] + matrix[12 + k]);
    assert_eq!(seen([1.0, 2.0, 3.0]), [0.0; 3]);
    assert_eq!(seen([3.0, 6.0, 3.5]), [2.0, 0.5, 4.0], "right, up, along the view");
}

#[test]
fn clip_rows_put_points_at_their_pixels() {
    let camera = Camera::new([5.0, -4.0, 3.0], [1.0, 2.0, 0.5], [0.0, 0.0, 1.0], 0.5, 64, 48).expect("a camera");
    let frame = UnitFrame::new([DVec3::splat(-1.0), DVec3::splat(3.0)]);
    let rows = camera.clip_rows(&frame).map(|row| row.map(f64::from));
    for [x, y] in [[0.5, 0.5], [63.5, 20.25], [32.0, 24.0]] {
        let point = frame.of_scene(wide(camera.eye()) + 7.0 * camera.direction_at(x, y));
        let [cx, cy, cz, cw] = rows.map(|[a, b, c, d]| a * point.x + b * point.y + c * point.z + d);
        assert_abs_diff_eq!(cw * frame.unit(), 7.0, epsilon = 1e-5);
        assert_abs_diff_eq!((cx / cw + 1.0) * 32.0, x, epsilon = 1e-4);
        assert_abs_diff_eq!((1.0 - cy / cw) * 24.0, y, epsilon = 1e-4);
        assert!((0.0..=cw).contains(&cz), "{cz} of {cw}");
    }
}

#[test]
fn what_makes_no_picture_is_refused() {
    let (ahead, up, nan) = ([0.0; 3], [0.0, 0.0, 1.0], [f32::NAN; 3]);
    for (target, up, tangent, width, said) in [
        ([1.0; 3], up, 0.5, 8, "eye, target and up define no picture plane"),
        ([1.0, 1.0, 2.0], up, 0.5, 8, "eye, target and up define no picture plane"),
        (ahead, [0.0; 3], 0.5, 8, "eye, target and up define no picture plane"),
        (ahead, up, 0.0, 8, "expected a tangent of half the vertical field of view above 0 and up"),
        (ahead, up, 0.5, 0, "expected a picture of 1 to 2^30 pixels, found "),
        (ahead, nan, 0.5, 8, "expected finite figures for up, found "),
    ] {
        let error = Camera::new([1.0; 3], target, up, tangent, width, 8).expect_err("no picture").to_string();
        assert!(error.starts_with(said), "{error}");
    }
}
