//! SSIM: structural similarity (Wang, Bovik, Sheikh and Simoncelli, 2004, "Image quality assessment: from error
//! visibility to structural similarity").

use super::filter::{PixelPlane, normalized, taps};
use super::screen::ScreenPicture;

/// Side of the window, in pixels.
pub const WINDOW: usize = 11;
/// Standard deviation of its Gaussian, in pixels.
const DEVIATION: f64 = 1.5;
/// Squares of the paper's K1 and K2, for values up to 1.
const C1: f64 = 0.01 * 0.01;
const C2: f64 = 0.03 * 0.03;

/// Mean structural similarity of the luma over all windows that lie within the pictures: 1 for equal pictures, at least
/// -1. `None` if the pictures are smaller than a window, or of different sizes.
pub fn ssim(left: &ScreenPicture, right: &ScreenPicture) -> Option<f64> {
    let (width, height) = (left.width, left.height);
    if (width, height) != (right.width, right.height) || width.min(height) < WINDOW {
        return None;
    }
    let radius = WINDOW / 2;
    let gaussian = normalized(&taps(radius as u32, |x| crate::elementary::exp(-x * x / (2.0 * DEVIATION * DEVIATION))));
    let mean = |values: Vec<f64>| PixelPlane { width, values }.filtered(&gaussian, &gaussian).values;
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).collect::<Vec<f64>>();
    let (x, y) = (left.luma(), right.luma());
    let [xx, yy, xy] = [product(&x, &x), product(&y, &y), product(&x, &y)].map(mean);
    let [x, y] = [x, y].map(mean);
    let (mut sum, mut count) = (0.0, 0_u64);
    for row in radius..height - radius {
        for at in row * width + radius..(row + 1) * width - radius {
            let (mx, my) = (x[at], y[at]);
            let [vx, vy, cov] = [xx[at] - mx * mx, yy[at] - my * my, xy[at] - mx * my];
            let light = (2.0 * mx * my + C1) / (mx * mx + my * my + C1);
            sum += light * ((2.0 * cov + C2) / (vx + vy + C2));
            count += 1;
        }
    }
    Some(sum / count as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::Picture;
    use crate::picture::display::{curve, decode};

    fn screen(side: u32, pixel: impl Fn(u32, u32) -> f64) -> ScreenPicture {
        let pixels: Vec<[f32; 3]> =
            (0..side * side).map(|at| [decode(pixel(at % side, at / side)) as f32; 3]).collect();
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

    /// Without structure only the term of the means remains.
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
}
