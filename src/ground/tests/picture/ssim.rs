use crossbar_ground::picture::Picture;
use crossbar_ground::picture::display::{curve, decode};
use crossbar_ground::picture::metrics::{ScreenPicture, ssim};

fn screen(side: u32, pixel: impl Fn(u32, u32) -> f64) -> ScreenPicture {
    let pixels: Vec<[f32; 3]> = (0..side * side).map(|at| [decode(pixel(at % side, at / side)) as f32; 3]).collect();
    ScreenPicture::new(&Picture::rgb(side, side, &pixels), 1.0).expect("color")
}

#[test]
fn equal_pictures_have_similarity_one_and_the_order_does_not_matter() {
    let one = screen(24, |x, y| f64::from((x * 7 + y * 3) % 16) / 15.0);
    let other = screen(24, |x, y| f64::from((x * 5 + y * 11) % 16) / 15.0);
    assert_eq!(ssim(&one, &one), Some(1.0));
    assert_eq!(ssim(&one, &other), ssim(&other, &one));
    assert!(ssim(&one, &other).is_some_and(|similarity| similarity < 0.5));
    let negative = screen(24, |x, y| 1.0 - f64::from((x * 7 + y * 3) % 16) / 15.0);
    assert!(ssim(&one, &negative).is_some_and(|similarity| similarity < -0.5), "what is inverted is unlike");
}

/// Without structure, only the term of the means is left.
#[test]
fn two_greys_are_as_alike_as_the_formula_says() {
    let (a, b) = (0.25, 0.75);
    let found = ssim(&screen(16, |_, _| a), &screen(16, |_, _| b)).expect("large enough");
    assert!((found - (2.0 * a * b + 1e-4) / (a * a + b * b + 1e-4)).abs() < 1e-6, "{found}");
    assert!((curve(decode(a)) - a).abs() < 1e-12);
}

#[test]
fn small_pictures_have_no_window() {
    assert_eq!(ssim(&screen(10, |_, _| 0.0), &screen(10, |_, _| 0.0)), None);
    assert_eq!(ssim(&screen(11, |_, _| 0.0), &screen(11, |_, _| 0.0)), Some(1.0));
}
