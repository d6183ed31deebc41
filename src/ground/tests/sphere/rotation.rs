use crossbar_ground::sphere::HarmonicRotation;
use glam::{DMat3, DVec3};

#[test]
fn what_is_no_rotation_is_refused() {
    let error = |matrix: &DMat3| HarmonicRotation::new(3, matrix).expect_err("refused").to_string();
    let mirrored = DMat3::from_diagonal(DVec3::new(1.0, 1.0, -1.0));
    let reflection =
        "expected a rotation matrix, found a reflection (determinant -1); exchange two columns, or negate one";
    assert_eq!(error(&mirrored), reflection);
    let skewed = DMat3::from_cols(DVec3::X, DVec3::new(0.5, 1.0, 0.0), DVec3::Z);
    let skew = "expected a rotation matrix with orthonormal columns (to 0.000000001), found columns [1, 1] (counted from 0) \
                with product 1.25; orthonormalize them in double precision";
    assert_eq!(error(&skewed), skew);
    assert!(HarmonicRotation::new(3, &DMat3::from_diagonal(DVec3::NAN)).is_err());
}
