//! A sequence of pictures from the ray-traced one to the picture from transfer, each of which adds one approximation,
//! and their differences.

use crate::bi_scale::shade::TracedRung;
use crate::picture::metrics::{ErrorSums, value_error};
use crate::report::{Cell, Table};

#[derive(Clone, Debug)]
pub(in crate::study) struct CausePictures {
    /// Approximation that each picture after the first adds to the previous one: a word, and a sentence.
    pub(in crate::study) causes: Vec<(&'static str, String)>,
    /// The ray-traced picture first, the picture from transfer last.
    pub(in crate::study) pictures: Vec<Vec<[f64; 3]>>,
}

impl CausePictures {
    /// The ray-traced picture.
    pub(in crate::study) fn exact(&self) -> &[[f64; 3]] {
        self.pictures.first().map_or(&[], Vec::as_slice)
    }

    /// The picture from transfer.
    pub(in crate::study) fn drawn(&self) -> &[[f64; 3]] {
        self.pictures.last().map_or(&[], Vec::as_slice)
    }

    /// The ray-traced picture in which textures replace patches, as in transfer.
    pub(in crate::study) fn textured(&self) -> &[[f64; 3]] {
        self.pictures.get(TracedRung::Texture as usize).map_or(&[], Vec::as_slice)
    }

    /// RMS difference of two pictures, in percent of the RMS of the ray-traced picture; 0 if that picture is black.
    pub(in crate::study) fn apart(&self, one: &[[f64; 3]], other: &[[f64; 3]]) -> f64 {
        let whole: f64 = self.exact().iter().flatten().map(|value| value * value).sum();
        if whole > 0.0 { 100.0 * (differences(one, other).0 / whole).sqrt() } else { 0.0 }
    }

    /// Table with a row per cause.
    pub(in crate::study) fn table(&self, title: &str) -> Table {
        let mut table = Table::new(title, &["cause", "step (%)", "up to here (%)", "largest (radiance)"]);
        for ((before, after), cause) in self.pictures.iter().zip(&self.pictures[1..]).zip(&self.causes) {
            table.push([
                cause.1.as_str().into(),
                Cell::measured(self.apart(before, after)),
                Cell::measured(self.apart(self.exact(), after)),
                Cell::measured(differences(before, after).1),
            ]);
        }
        table
    }
}

/// The sum of squared differences over all channels, and the largest difference.
fn differences(one: &[[f64; 3]], other: &[[f64; 3]]) -> (f64, f64) {
    let mut sums = ErrorSums::default();
    one.iter().flatten().zip(other.iter().flatten()).for_each(|(&a, &b)| sums.add(value_error(a, b), 1.0));
    (sums.squares(), sums.largest)
}
