use crossbar_ground::picture::display::{decode, encode};

#[test]
fn the_curve_at_points_that_are_known() {
    let known = [(0.0, 0), (1.0, 255), (7.0, 255), (-1.0, 0), (f64::NAN, 0), (0.215_860_5, 128), (0.5, 188)];
    for (linear, byte) in known {
        assert_eq!(encode(linear), byte, "{linear}");
    }
}

#[test]
fn every_byte_comes_back() {
    for byte in 0..=255 {
        assert_eq!(encode(decode(f64::from(byte) / 255.0)), byte);
    }
}
