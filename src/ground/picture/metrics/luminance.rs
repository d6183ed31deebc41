//! Signed differences of luminance, for false colors.

use super::super::channels::Picture;
use super::error_sums::value_error;
use crate::error::InputError;

/// Rec. 709 luma weights of red, green and blue.
pub(super) const WEIGHTS: [f64; 3] = [0.2126, 0.7152, 0.0722];

/// Computes the differences of luminance times `exposure`, second minus first, pixel by pixel, without clipping.
pub fn luminance_differences(first: &Picture, second: &Picture, exposure: f64) -> Result<Vec<f64>, InputError> {
    let pairs = luminance(first)?.into_iter().zip(luminance(second)?);
    Ok(pairs.map(|(a, b)| exposure * value_error(b, a)).collect())
}

/// Computes the differences of luminance relative to the first picture: -0.1 means a tenth darker. If the first is
/// black, the result is 0 if the second is black too, otherwise not finite. Fails as [`luminance_differences`] does.
pub fn relative_luminance_differences(first: &Picture, second: &Picture) -> Result<Vec<f64>, InputError> {
    let pairs = luminance(first)?.into_iter().zip(luminance(second)?);
    Ok(pairs.map(|(a, b)| if a == b { 0.0 } else { (b - a) / a }).collect())
}

fn luminance(picture: &Picture) -> Result<Vec<f64>, InputError> {
    let of = |pixel: [f32; 3]| [0, 1, 2].iter().map(|&c| WEIGHTS[c] * f64::from(pixel[c])).sum();
    Ok(picture.linear()?.into_iter().map(of).collect())
}
