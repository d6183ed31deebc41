//! Signed differences of luminance, for false colors.

use super::super::channels::Picture;
use super::error_sums::value_error;
use crate::error::InputError;

/// Rec. 709 luma weights of red, green and blue.
pub(super) const WEIGHTS: [f64; 3] = [0.2126, 0.7152, 0.0722];

/// Computes second minus first, pixel by pixel, of the luminance times `exposure`, without clipping.
///
/// # Errors
/// [`InputError`] if a picture has neither `R`, `G` and `B` nor `Y`.
pub fn luminance_differences(first: &Picture, second: &Picture, exposure: f64) -> Result<Vec<f64>, InputError> {
    let pairs = luminance(first)?.into_iter().zip(luminance(second)?);
    Ok(pairs.map(|(a, b)| exposure * value_error(b, a)).collect())
}

/// Computes the differences of luminance relative to the first picture: -0.1 is a tenth darker. Where the first is
/// black, 0 if the second is black too, otherwise not finite.
///
/// # Errors
/// As [`luminance_differences`].
pub fn relative_luminance_differences(first: &Picture, second: &Picture) -> Result<Vec<f64>, InputError> {
    let pairs = luminance(first)?.into_iter().zip(luminance(second)?);
    Ok(pairs.map(|(a, b)| if a == b { 0.0 } else { (b - a) / a }).collect())
}

fn luminance(picture: &Picture) -> Result<Vec<f64>, InputError> {
    let of = |pixel: [f32; 3]| [0, 1, 2].iter().map(|&c| WEIGHTS[c] * f64::from(pixel[c])).sum();
    Ok(picture.linear()?.into_iter().map(of).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

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
}
