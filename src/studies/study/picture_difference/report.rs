//! Tables, maps and page of the study.

use std::cmp::Reverse;

use serde_json::json;

use super::compare::{DifferenceOutcome, PerceptualDifference, PictureDifference};
use crate::picture::metrics::ChannelDifference;
use crate::picture::{ChannelUnit, Picture, Samples};
use crate::report::digits::{Quantity, shown};
use crate::report::words::counted;
use crate::report::{Cell, Findings, FoundTable, NamedPicture, Table, Verdict, false_color};
use crate::study::{ProgressFn, Study, StudyError};

const FLIP: &str = "FLIP is the difference seen when flipping between the two pictures: 0 means none, 1 the largest. \
    SSIM compares the structure of the luma in windows of 11 x 11 pixels: 1 means equal.";

impl Study for PictureDifference {
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        let outcome = self.compare(progress)?;
        findings(self, outcome)
    }
}

fn findings(study: &PictureDifference, outcome: DifferenceOutcome) -> Result<Findings, StudyError> {
    let [first, second] = &study.pictures;
    let mut found = Findings::new("Two pictures");
    let held = study.holds(&outcome);
    found.conclude(Verdict::held(held));
    found.conclusion(conclusion(&outcome.channels));
    if study.options.is_bounded() {
        found.conclusion(if held { "Within all bounds." } else { "Out of bounds." });
    }
    found.paragraph(format!(
        "{} against {}, {} x {} pixels. Differences are the second picture minus the first.",
        first.name,
        second.name,
        first.picture.width(),
        first.picture.height()
    ));
    found.field("equal", outcome.channels.iter().all(|channel| channel.differing == 0).into());
    found.field("held", held.into());
    found.table(FoundTable::from(table(&outcome.channels)).csv("channels").field("channels"));
    if let Some(perceptual) = &outcome.perceptual {
        add_metrics(&mut found, study, perceptual);
    }
    if study.maps {
        maps(&mut found, study, &outcome)?;
    }
    Ok(found)
}

/// Sentence about the number of channels that differ.
fn conclusion(channels: &[ChannelDifference]) -> String {
    let all = channels.len();
    match channels.iter().filter(|channel| channel.differing > 0).count() {
        0 => "The pictures are equal in every sample.".to_owned(),
        differing => format!("The pictures differ in {differing} of {}.", counted(all as u64, "channel", "channels")),
    }
}

fn table(channels: &[ChannelDifference]) -> Table {
    let columns = "channel differing not_finite nan_first nan_second rmse mean maximum x y first second";
    let mut table = Table::of("Samples by channel", columns);
    for channel in channels {
        let number = |value: f64| if channel.whole { Cell::Empty } else { Cell::error(value) };
        let worst = channel.worst;
        table.push([
            channel.name.as_str().into(),
            channel.differing.into(),
            channel.not_finite.into(),
            channel.nan[0].into(),
            channel.nan[1].into(),
            number(channel.rmse),
            number(channel.mean),
            number(channel.maximum),
            worst.map(|worst| worst.x).into(),
            worst.map(|worst| worst.y).into(),
            worst.map_or(Cell::Empty, |worst| Cell::measured(worst.left)),
            worst.map_or(Cell::Empty, |worst| Cell::measured(worst.right)),
        ]);
    }
    table
}

/// Adds SSIM and FLIP, as sentences and as fields of the JSON.
fn add_metrics(found: &mut Findings, study: &PictureDifference, perceptual: &PerceptualDifference) {
    let (flip, ppd) = (&perceptual.flip, shown(study.options.pixels_per_degree(), Quantity::Measured));
    let [mean, maximum] = [flip.mean, flip.maximum].map(|value| shown(value, Quantity::Error));
    let similarity =
        perceptual.ssim.map_or("not computed (the pictures are smaller than a window of 11x11)".to_owned(), |ssim| {
            shown(ssim, Quantity::Measured)
        });
    let line = format!("SSIM {similarity}; FLIP mean {mean}, largest {maximum}, at {ppd} pixels per degree");
    found.print(line.clone());
    found.paragraph(format!("{line}. {FLIP}"));
    found.field("ssim", json!(perceptual.ssim));
    found
        .field("flip", json!({ "mean": flip.mean, "maximum": flip.maximum, "ppd": study.options.pixels_per_degree() }));
    found.field("exposure", json!(study.options.exposure));
}

/// Adds false-color maps, and all differences as numbers.
fn maps(found: &mut Findings, study: &PictureDifference, outcome: &DifferenceOutcome) -> Result<(), StudyError> {
    let [first, second] = &study.pictures;
    let (width, height) = (first.picture.width(), first.picture.height());
    let mut pictures = Vec::new();
    for (name, input) in [("first", first), ("second", second)] {
        if let Ok(image) = input.picture.display(study.options.exposure) {
            pictures.push(NamedPicture::new(name, image, input.name.clone()));
        }
    }
    let (what, values) = match &outcome.perceptual {
        Some(perceptual) => ("luminance".to_owned(), perceptual.luminance.clone()),
        None => most_differing(outcome),
    };
    let scale = study.options.scale.unwrap_or_else(|| usual_scale(&values));
    let ends = shown(scale, Quantity::Error);
    let caption = format!(
        "{what}, second minus first: blue -{ends} or less, white 0, red +{ends} or more; black where not finite"
    );
    found.print(format!("difference.png: {caption}"));
    found.field("scale", json!(scale));
    pictures.push(NamedPicture::new("difference", false_color::signed(width, &values, scale), caption));
    let mut layers = Picture::new(width, height);
    for (name, samples) in &outcome.signed {
        let samples = Samples::Float(samples.clone());
        layers = layers.with(name, ChannelUnit::Unknown, samples)?;
    }
    if let Some(perceptual) = &outcome.perceptual {
        let caption = "FLIP: black 0, pale yellow 1";
        pictures.push(NamedPicture::new("flip", false_color::magnitude(width, &perceptual.flip.errors), caption));
        let samples = Samples::Float(perceptual.flip.errors.iter().map(|&error| error as f32).collect());
        layers = layers.with("FLIP", ChannelUnit::Unknown, samples)?;
    }
    found.heading("Pictures");
    found.pictures(pictures);
    found.keep_layers("difference", layers);
    Ok(())
}

/// 99th percentile of the magnitudes of differing pixels, so that a few large differences do not make all others pale.
fn usual_scale(values: &[f64]) -> f64 {
    let mut sizes: Vec<f64> = values.iter().map(|value| value.abs()).filter(|x| x.is_finite() && *x > 0.0).collect();
    sizes.sort_unstable_by(f64::total_cmp);
    sizes.get((sizes.len() * 99).div_ceil(100).saturating_sub(1)).copied().unwrap_or(1.0)
}

/// The channel in which most samples differ, the first on a tie.
fn most_differing(outcome: &DifferenceOutcome) -> (String, Vec<f64>) {
    let channels = outcome.channels.iter().zip(&outcome.signed);
    let most = channels.min_by_key(|(channel, _)| Reverse(channel.differing));
    most.map_or_else(Default::default, |(_, (name, values))| {
        (format!("channel {name}"), values.iter().map(|&value| f64::from(value)).collect())
    })
}
