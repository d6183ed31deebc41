//! Number formats, maps and targets varied one after the other, compared with a picture in single precision throughout.

use refsim::device::Profile;
use refsim::texture::TexelFormat;
use strum::IntoEnumIterator;

use super::picture::CardDrawing;
use super::subject::OnCard;
use crate::card::SeenPixel;
use crate::cpca::on_card::{CompressedTransfer, PrtCardOptions, WeightFormat};
use crate::study::StudyError;
use crate::study::prt::card::PictureVariant;
use crate::study::prt::card::difference::{PixelErrors, held};
use crate::study::prt::no_cpca_card;

/// Side of the reference picture's maps, in texels.
const FINE: usize = 512;
/// Sides of maps to try, in texels.
const SIDES: [usize; 5] = [8, 16, 32, 64, 128];

/// A variant of the reference picture.
struct Choice {
    /// The varied setting.
    axis: &'static str,
    label: String,
    device: &'static str,
    format: TexelFormat,
    options: PrtCardOptions,
}

pub(super) const EXPLAINED: &str = "Each row changes one thing in a picture in single precision, with maps of 512 x \
    512 texels in floats and a target of floats, and is compared with that picture where pixels show the mesh. \
    Visible: pixels of which a channel is off by more than one 255th. Targets of fractions clamp at 0 after each group \
    of clusters: negative light is lost if the group that balances it is drawn later. `together` draws clusters in \
    groups, `alone` one after the other.";

/// The reference: single precision everywhere, large maps in single precision, and a float target.
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

/// Number of pictures of a sweep.
pub(super) fn pictures(transfer: &CompressedTransfer<'_>) -> u64 {
    1 + choices(transfer.is_glossy()).len() as u64
}

/// Draws all variants, and compares them with the reference at pixels that show the mesh.
pub(super) fn variants(
    study: &OnCard,
    transfer: CompressedTransfer<'_>,
    exposure: f64,
    seen: &[Option<SeenPixel>],
    progress: &mut dyn FnMut(u64),
) -> Result<Vec<PictureVariant>, StudyError> {
    let draw = |choice: &Choice| -> Result<Vec<[f64; 3]>, StudyError> {
        let profile = Profile::named(choice.device)?;
        let way = CardDrawing { profile: &profile, format: choice.format, options: choice.options, timed: false };
        Ok(held(&way.draw(study, transfer, exposure).map_err(no_cpca_card)?.colors, true))
    };
    let expected = draw(&reference())?;
    let mut variants = Vec::new();
    for choice in choices(transfer.is_glossy()) {
        progress(1 + variants.len() as u64);
        let errors = PixelErrors::of(seen, &draw(&choice)?, &expected);
        variants.push(PictureVariant { axis: choice.axis, choice: choice.label, errors, below_zero: None });
    }
    Ok(variants)
}
