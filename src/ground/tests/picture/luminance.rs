use crossbar_ground::picture::Picture;
use crossbar_ground::picture::metrics::{luminance_differences, relative_luminance_differences};

#[test]
fn a_tenth_darker_is_a_tenth_darker() {
    let first = Picture::rgb(3, 1, &[[2.0; 3], [0.0; 3], [0.0; 3]]);
    let second = Picture::rgb(3, 1, &[[1.5; 3], [0.0; 3], [1.0; 3]]);
    let near = |found: f64, want: f64| (found - want).abs() < 1e-12;
    let found = luminance_differences(&first, &second, 2.0).expect("color");
    assert!(near(found[0], -1.0) && near(found[1], 0.0) && near(found[2], 2.0), "{found:?}");
    let found = relative_luminance_differences(&first, &second).expect("color");
    assert!(near(found[0], -0.25) && near(found[1], 0.0) && found[2].is_infinite(), "{found:?}");
}
