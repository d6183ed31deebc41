//! SSIM: structural similarity (Wang, Bovik, Sheikh and Simoncelli, 2004, "Image quality assessment: from error
//! visibility to structural similarity").

use super::filter::{PixelPlane, normalized, taps};
use super::screen::ScreenPicture;

/// Side of the window, in pixels.
pub const WINDOW: usize = 11;
/// Standard deviation of the window's Gaussian, in pixels.
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
