//! Transferred radiance from representatives and weights with fewer bits.

use super::pixels::exact_pixels;
use super::subject::{AllFrequencyOnCard, in_double};
use crate::all_frequency::code::{CodeOptions, CodedTransfer};
use crate::all_frequency::on_card::{ProductOptions, ProductPlace};
use crate::card::SeenPixel;
use crate::study::StudyError;
use crate::study::prt::card::{PictureVariant, PixelErrors};
use crate::transfer::light::HaarLight;

/// Numbers of bits to try, if the file has more.
const BITS: [u8; 5] = [8, 10, 12, 14, 15];

/// Variants of a file's code.
fn choices(coded: &CodedTransfer) -> Vec<(&'static str, u8, CodeOptions)> {
    let of = coded.options;
    let mut all = Vec::new();
    for bits in BITS.into_iter().filter(|&bits| bits < of.representative_bits) {
        all.push(("representatives", bits, CodeOptions { representative_bits: bits, ..of }));
    }
    for bits in BITS.into_iter().filter(|&bits| bits < of.weight_bits) {
        all.push(("weights", bits, CodeOptions { weight_bits: bits, ..of }));
    }
    all
}

/// Number of pictures of [`coarse_codes`].
pub(super) fn ways_to_code(coded: &CodedTransfer) -> u64 {
    1 + choices(coded).len() as u64
}

/// Varies the code of the model alone: sums and pixels are in f64.
pub(super) fn coarse_codes(
    study: &AllFrequencyOnCard,
    (coded, light): (&CodedTransfer, &HaarLight),
    seen: &[Option<SeenPixel>],
    exposure: f64,
    done: &mut dyn FnMut(u64),
) -> Result<Vec<PictureVariant>, StudyError> {
    let place = ProductPlace::Pixels(ProductOptions::default());
    let mut transferred = study.in_double(light)?;
    let mut pixels = |coded: &CodedTransfer| -> Result<Vec<[f64; 3]>, StudyError> {
        transferred[0] = in_double(coded, light)?;
        Ok(exact_pixels(&study.meshes(&transferred), seen, &place, study.lit.view.camera.eye(), exposure))
    };
    let expected = pixels(coded)?;
    done(1);
    let mut found = Vec::new();
    for (axis, bits, options) in choices(coded) {
        let errors = PixelErrors::of(seen, &pixels(&coded.recoded(options)?)?, &expected);
        found.push(PictureVariant { axis, choice: format!("{bits} bits"), errors, below_zero: None });
        done(1 + found.len() as u64);
    }
    Ok(found)
}
