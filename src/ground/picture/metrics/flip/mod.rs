//! LDR-FLIP: the difference that an observer notices when flipping between two pictures (Andersson, Nilsson,
//! Akenine-Möller, Oskarsson, Åström and Fairchild, 2020, "FLIP: a difference evaluator for alternating images").
//!
//! Colors are filtered by contrast sensitivity and compared with a distance that is suitable for large color
//! differences; where edges or points appear or vanish, the difference is amplified. Tests compare it with values from
//! the authors' program.

mod color;
mod features;

use rayon::prelude::*;

use super::filter::{PixelPlane, taps};
use super::screen::ScreenPicture;
use crate::elementary::{exp, pow};
use color::{from_opponents, hyab, to_hunt_lab, to_opponents};
use features::Features;

/// Pixels per degree of an observer 0.7 m in front of a screen 0.7 m wide with 3840 pixels across.
pub const DEFAULT_PPD: f64 = 3840.0 * std::f64::consts::PI / 180.0;
/// Minimum pixels per degree.
pub const MIN_PPD: f64 = 1.0;
/// Maximum pixels per degree.
pub const MAX_PPD: f64 = 1000.0;

const COLOR_EXPONENT: f64 = 0.7;
const FEATURE_EXPONENT: f64 = 0.5;
/// Fraction of the largest color difference that is mapped to [`KNEE_ERROR`].
const KNEE: f64 = 0.4;
const KNEE_ERROR: f64 = 0.95;
/// Contrast sensitivity: pairs of weight and width, in degrees, of Gaussians for lightness, red against green, and
/// yellow against blue.
const LIGHTNESS: [f64; 2] = [1.0, 0.0047];
const RED_GREEN: [f64; 2] = [1.0, 0.0053];
const BLUE_YELLOW: [[f64; 2]; 2] = [[34.1, 0.04], [13.5, 0.025]];

/// FLIP per pixel, in [0, 1].
#[derive(Clone, Debug, PartialEq)]
pub struct FlipMap {
    /// Rows from the top.
    pub errors: Vec<f64>,
    /// Mean error.
    pub mean: f64,
    /// Maximum error.
    pub maximum: f64,
}

/// Computes FLIP between two pictures of the same size, for an observer who sees `ppd` pixels per degree, which is
/// clipped to [[`MIN_PPD`], [`MAX_PPD`]]. `None` if the sizes differ.
pub fn flip(left: &ScreenPicture, right: &ScreenPicture, ppd: f64) -> Option<FlipMap> {
    if (left.width, left.height) != (right.width, right.height) {
        return None;
    }
    let ppd = if ppd > MIN_PPD { ppd.min(MAX_PPD) } else { MIN_PPD };
    let [(colors, features), (other_colors, other_features)] = [left, right].map(|picture| perceived(picture, ppd));
    // Of all colors of the screen, green and blue are farthest apart.
    let largest = pow(hyab(to_hunt_lab([0.0, 1.0, 0.0]), to_hunt_lab([0.0, 0.0, 1.0])), COLOR_EXPONENT);
    let knee = KNEE * largest;
    let error = |at: usize| {
        let distance = pow(hyab(colors[at], other_colors[at]), COLOR_EXPONENT);
        let color = match distance < knee {
            true => KNEE_ERROR / knee * distance,
            false => KNEE_ERROR + (distance - knee) / (largest - knee) * (1.0 - KNEE_ERROR),
        };
        let feature = pow(features.difference(&other_features, at) / std::f64::consts::SQRT_2, FEATURE_EXPONENT);
        pow(color.min(1.0), 1.0 - feature.min(1.0))
    };
    let errors: Vec<f64> = (0..colors.len()).into_par_iter().map(error).collect();
    let mean = errors.iter().sum::<f64>() / errors.len().max(1) as f64;
    let maximum = errors.iter().copied().fold(0.0, f64::max);
    Some(FlipMap { errors, mean, maximum })
}

fn perceived(picture: &ScreenPicture, ppd: f64) -> (Vec<[f64; 3]>, Features) {
    let width = picture.width;
    let opponents: Vec<[f64; 3]> = picture.linear.par_iter().map(|&linear| to_opponents(linear)).collect();
    let plane = |channel: usize| PixelPlane { width, values: opponents.iter().map(|pixel| pixel[channel]).collect() };
    let lightness = plane(0);
    let features =
        Features::of(&PixelPlane { width, values: lightness.values.iter().map(|y| (y + 16.0) / 116.0).collect() }, ppd);
    let filtered = [
        contrast_filtered(&lightness, &[LIGHTNESS], ppd),
        contrast_filtered(&plane(1), &[RED_GREEN], ppd),
        contrast_filtered(&plane(2), &BLUE_YELLOW, ppd),
    ];
    let color = |at: usize| {
        let [y, cx, cz] = [0, 1, 2].map(|channel| filtered[channel][at]);
        to_hunt_lab(from_opponents([y, cx, cz]).map(|channel| channel.clamp(0.0, 1.0)))
    };
    ((0..opponents.len()).into_par_iter().map(color).collect(), features)
}

/// Filters a plane by a sum of Gaussians, whose weights sum to 1.
fn contrast_filtered(plane: &PixelPlane, gaussians: &[[f64; 2]], ppd: f64) -> Vec<f64> {
    use std::f64::consts::PI;
    // All channels use three standard deviations of the widest Gaussian.
    let radius = (3.0 * (BLUE_YELLOW[0][1] / (2.0 * PI * PI)).sqrt() * ppd).ceil() as u32;
    let mut total = 0.0;
    let mut parts = Vec::new();
    for &[weight, width] in gaussians {
        let along = taps(radius, |x| exp(-PI * PI * (x / ppd) * (x / ppd) / width));
        let sum: f64 = along.iter().sum();
        let weight = weight * (PI / width).sqrt();
        total += weight * sum * sum;
        parts.push((weight, along));
    }
    let mut filtered = vec![0.0; plane.values.len()];
    for (weight, along) in parts {
        let values = plane.filtered(&along, &along).values;
        filtered.iter_mut().zip(values).for_each(|(sum, value)| *sum += weight / total * value);
    }
    filtered
}
