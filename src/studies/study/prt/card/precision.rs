//! One thing after the other made coarse, the rest without rounding to speak of: which of it shows, and what would do.

use refsim::device::Profile;
use refsim::texture::TexelFormat;
use strum::IntoEnumIterator;

use super::difference::held;
use super::picture::Way;
use super::subject::{CardError, OnCard};
use crate::cpca::on_card::{CompressedTransfer, PrtCardOptions, WeightFormat};
use crate::report::digits::{Quantity, shown};
use crate::report::{Cell, Findings, FoundTable, Table};

/// Maps as fine as the reference picture has them.
const FINE: usize = 512;
/// Maps that are tried.
const SIDES: [usize; 5] = [8, 16, 32, 64, 128];

/// A thing that is made coarse.
struct Choice {
    /// Of what it is a choice.
    axis: &'static str,
    label: String,
    device: &'static str,
    format: TexelFormat,
    options: PrtCardOptions,
}

const EXPLAINED: &str = "Each row is one change of a picture in single precision, with maps of 512 x 512 texels in floats and a target of floats, and \
    is compared with it. Visible: pixels of which a channel is off by more than one 255th. Targets of fractions clamp at 0 after each group of clusters, so that light taken away by one \
    part of a triangle that another group brings is lost; `together` draws clusters in groups, `alone` one after the other.";

/// The reference: single precision everywhere, maps of many texels in single precision, a float target.
fn reference() -> Choice {
    let options = PrtCardOptions { map_side: FINE, map_format: TexelFormat::Rgba32f, ..PrtCardOptions::default() };
    let (axis, label) = ("reference", format!("fp32, maps of {FINE}"));
    Choice { axis, label, device: "ideal-fp32", format: TexelFormat::Rgba32f, options }
}

fn choices(glossy: bool) -> Vec<Choice> {
    let of = |axis, label: String| Choice { axis, label, ..reference() };
    let mut all = Vec::new();
    for device in ["ideal-fp24", "ideal-fp16"] {
        all.push(Choice { device, ..of("pixel arithmetic", device.to_owned()) });
    }
    for weights in WeightFormat::iter().filter(|&weights| weights != WeightFormat::Fp32) {
        let options = PrtCardOptions { weights, ..reference().options };
        all.push(Choice { options, ..of("weights", weights.to_string()) });
    }
    if glossy {
        for map_side in SIDES {
            let options = PrtCardOptions { map_side, ..reference().options };
            all.push(Choice { options, ..of("map texels", format!("{map_side} x {map_side}")) });
        }
        for (map_format, name) in
            [(TexelFormat::Rgba16Snorm, "signed 16 bits"), (TexelFormat::Rgba8Snorm, "signed 8 bits")]
        {
            let options = PrtCardOptions { map_format, ..reference().options };
            all.push(Choice { options, ..of("map format", name.to_owned()) });
        }
    }
    for (format, name) in
        [(TexelFormat::Rgba16f, "fp16"), (TexelFormat::Rgba16, "16 bits"), (TexelFormat::Bgra8, "8 bits")]
    {
        for superclusters in [true, false] {
            let options = PrtCardOptions { superclusters, ..reference().options };
            let how = if superclusters { "together" } else { "alone" };
            all.push(Choice { format, options, ..of("target", format!("{name}, {how}")) });
        }
    }
    all
}

/// How many pictures a sweep takes.
pub(super) fn pictures(transfer: &CompressedTransfer<'_>) -> u64 {
    1 + choices(transfer.is_glossy()).len() as u64
}

/// Draws all choices; adds what was found.
pub(super) fn report(
    study: &OnCard,
    (transfer, exposure): (CompressedTransfer<'_>, f64),
    found: &mut Findings,
    progress: &mut dyn FnMut(u64),
) -> Result<(), CardError> {
    let draw = |choice: &Choice| -> Result<Vec<[f64; 3]>, CardError> {
        let profile = Profile::named(choice.device)?;
        let way = Way { profile: &profile, format: choice.format, options: choice.options, timed: false };
        Ok(held(&way.draw(study, transfer, exposure)?.colors, true))
    };
    let expected = draw(&reference())?;
    let mut table = Table::of("What shows", "what choice rms_255ths largest_255ths visible_%");
    let mut shows = Vec::new();
    for (done, choice) in (1..).zip(choices(transfer.is_glossy())) {
        progress(done);
        let difference = Difference::of(&draw(&choice)?, &expected);
        table.push([
            choice.axis.into(),
            choice.label.clone().into(),
            Cell::measured(STEPS * difference.rms),
            Cell::measured(STEPS * difference.largest),
            Cell::percent(100.0 * difference.visible as f64 / difference.pixels as f64),
        ]);
        shows.push((choice, difference));
    }
    conclude(&shows, found);
    found.heading("What shows");
    found.explained_table(FoundTable::from(table).csv("precision").field("precision"), EXPLAINED);
    Ok(())
}

/// The worst, and per axis what shows nothing.
fn conclude(all: &[(Choice, Difference)], found: &mut Findings) {
    let quiet: Vec<String> =
        all.iter().filter(|(_, d)| d.visible == 0).map(|(c, _)| format!("{} {}", c.axis, c.label)).collect();
    found.conclusion(if quiet.is_empty() {
        "Everything that was made coarse shows.".to_owned()
    } else {
        format!("What shows nothing, alone: {}.", quiet.join("; "))
    });
    if let Some((choice, difference)) = all.iter().max_by(|a, b| a.1.rms.total_cmp(&b.1.rms)) {
        found.conclusion(format!(
            "Most is to blame on {} {}: {} 255ths root mean square.",
            choice.axis,
            choice.label,
            shown(STEPS * difference.rms, Quantity::Measured)
        ));
    }
}

/// Steps of a picture of 8 bits.
const STEPS: f64 = 255.0;

/// How two pictures of values from 0 to 1 differ, over all pixels.
struct Difference {
    rms: f64,
    largest: f64,
    /// Pixels of which a channel differs by more than a step of 8 bits.
    visible: usize,
    pixels: usize,
}

impl Difference {
    /// By the channel of each pixel that differs most.
    fn of(found: &[[f64; 3]], expected: &[[f64; 3]]) -> Self {
        let worst = |(found, expected): (&[f64; 3], &[f64; 3])| {
            found.iter().zip(expected).fold(0.0, |worst: f64, (found, expected)| worst.max((found - expected).abs()))
        };
        let of_pixel: Vec<f64> = found.iter().zip(expected).map(worst).collect();
        let pixels = of_pixel.len().max(1);
        let squares = of_pixel.iter().map(|value| value * value).sum::<f64>();
        Self {
            rms: (squares / pixels as f64).sqrt(),
            largest: of_pixel.iter().fold(0.0, |most: f64, &value| most.max(value)),
            visible: of_pixel.iter().filter(|&&value| value * STEPS > 1.0).count(),
            pixels,
        }
    }
}
