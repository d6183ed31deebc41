//! Pictures: the model, and the maps of the passes (Figures 5 to 7).

use super::WayRow;
use super::outcome::SubsurfaceOutcome;
use crate::picture::display::encode;
use crate::picture::metrics::value_error;
use crate::picture::{Picture, RgbImage, rgb8};
use crate::report::{NamedPicture, false_color};
use crate::study::StudyError;
use crate::study::prt::auto_exposure;

/// Auto-exposure: the model is 18 % grey on average; pixels without a surface do not count.
pub(super) fn exposure(outcome: &SubsurfaceOutcome) -> Result<f64, StudyError> {
    let Some(first) = outcome.rows.first() else { return Ok(1.0) };
    let colors: Vec<[f64; 3]> = first.picture.linear()?.into_iter().map(|pixel| pixel.map(f64::from)).collect();
    Ok(auto_exposure(&colors))
}

/// Figure 7: the first way of gathering, with and without scattered light, and scattered light alone.
pub(super) fn lead(row: &WayRow, exposure: f64) -> Result<Vec<NamedPicture>, StudyError> {
    let (whole, scattered) = (row.picture.linear()?, row.scattered.linear()?);
    let direct: Vec<[f32; 3]> = whole.iter().zip(&scattered).map(|(w, s)| [0, 1, 2].map(|c| w[c] - s[c])).collect();
    let together = row.picture.display(exposure)?;
    let (width, height) = together.dimensions();
    let direct = Picture::rgb(width, height, &direct).display(exposure)?;
    Ok(vec![
        NamedPicture::new("direct", direct, "without subsurface scattering: the difference of the other two pictures"),
        NamedPicture::new(
            "whole",
            row.picture.display(exposure)?,
            format!("{}: direct and scattered light", row.label),
        ),
        NamedPicture::new("scattered", row.scattered.display(exposure)?, "scattered light alone"),
    ])
}

pub(super) fn ways(rows: &[WayRow], exposure: f64) -> Result<Vec<NamedPicture>, StudyError> {
    let picture = |row: &WayRow| {
        let image = row.scattered.display(exposure)?;
        Ok(NamedPicture::new(format!("{}-scattered", row.label), image, format!("{}: scattered light", row.label)))
    };
    rows.iter().map(picture).collect()
}

/// The atlas after passes 1 and 2 (Figure 6); in each map, the brightest channel is white.
pub(super) fn maps(outcome: &SubsurfaceOutcome) -> Vec<NamedPicture> {
    let Some(first) = outcome.rows.first() else { return Vec::new() };
    let picture = |name: &str, values: &[[f64; 3]], what: &str| {
        NamedPicture::new(name, atlas(outcome.atlas.side(), values), what)
    };
    vec![
        picture("pass-1", &first.irradiance, "pass 1: what enters each texel, E"),
        picture("pass-2", &first.radiosity, "pass 2: what is scattered to it, B"),
    ]
}

fn atlas(side: u32, values: &[[f64; 3]]) -> RgbImage {
    let most = values.iter().flatten().copied().fold(f64::MIN_POSITIVE, f64::max);
    rgb8(side, side, values.iter().map(|value| value.map(|channel| encode(channel / most))))
}

/// Differences of B, by each way of gathering, from B over all pairs: on the atlas, in false colors with one scale.
pub(super) fn errors(outcome: &SubsurfaceOutcome) -> Vec<NamedPicture> {
    let Some(truth) = &outcome.truth else { return Vec::new() };
    let most = truth.iter().flatten().copied().filter(|b| b.is_finite()).fold(0.0, f64::max);
    let error = |row: &WayRow| -> Vec<f64> {
        let texel = |(b, t): (&[f64; 3], &[f64; 3])| {
            let off = [0, 1, 2].map(|channel| value_error(b[channel], t[channel]));
            off.into_iter().max_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or(0.0) / most
        };
        row.radiosity.iter().zip(truth).map(texel).collect()
    };
    let errors: Vec<(&str, Vec<f64>)> = outcome.rows.iter().map(|row| (row.label.as_str(), error(row))).collect();
    false_color::errors(outcome.atlas.side(), &errors, |label, ends| {
        format!(
            "{label} minus the sum over all pairs, in per cent of the brightest value: blue -{ends} % (darker), white 0, red +{ends} %"
        )
    })
}
