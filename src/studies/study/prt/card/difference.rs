//! Difference of a card's picture from the host's, per pixel of the card's raster.

use crate::card::SeenPixel;
use crate::picture::metrics::{ErrorSums, value_error};
use crate::report::Cell;
use crate::report::digits::{Quantity, shown};
use crate::report::words::{counted, percent};

/// Number of steps between the codes of an 8-bit picture, from black to white.
pub(super) const STEPS: f64 = 255.0;

/// Errors of the pixels that show the mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PixelErrors {
    /// RMS and largest difference of a channel, in 255ths of white; infinite if a pixel is not finite.
    pub off_255ths: [f64; 2],
    /// Fraction of the pixels with a channel that is not finite, or whose error exceeds one 255th.
    pub visible: f64,
    /// Number of pixels that are not finite where the expected ones are, or the reverse.
    pub not_finite: u64,
    /// RMS over the finite pixels, in 255ths.
    pub(super) finite_rms: f64,
}

impl PixelErrors {
    /// Compares pixels, row by row, with expected ones; pixels without a surface do not count.
    pub(super) fn of(seen: &[Option<SeenPixel>], found: &[[f64; 3]], expected: &[[f64; 3]]) -> Self {
        let shown = seen.iter().zip(found.iter().zip(expected)).filter(|(seen, _)| seen.is_some());
        let off: Vec<[f64; 3]> =
            shown.map(|(_, (a, b))| [0, 1, 2].map(|channel| STEPS * value_error(a[channel], b[channel]))).collect();
        let mut sums = ErrorSums::default();
        off.as_flattened().iter().for_each(|error| sums.add(*error, 1.0));
        let beyond = |limit: f64| off.iter().filter(|pixel| pixel.iter().any(|error| error.abs() > limit)).count();
        Self {
            off_255ths: [sums.rms(), sums.largest],
            visible: beyond(1.0) as f64 / off.len().max(1) as f64,
            not_finite: beyond(f64::MAX) as u64,
            finite_rms: sums.of_finite().rms(),
        }
    }

    /// Cells of a table: root mean square, largest, percent of the pixels.
    pub(super) fn cells(&self) -> [Cell; 3] {
        let [rms, largest] = self.off_255ths.map(Cell::measured);
        [rms, largest, Cell::percent(100.0 * self.visible)]
    }

    /// Sentence about the errors of the card, compared with the host's computation `from` the same numbers.
    pub(super) fn sentence(&self, card: &str, from: &str) -> String {
        let [rms, largest] = self.off_255ths.map(|steps| shown(steps, Quantity::Measured));
        let not_finite = match self.not_finite {
            0 => String::new(),
            count => format!(" {} not finite.", counted(count, "pixel is", "pixels are")),
        };
        format!(
            "{card}: off by {rms} 255ths (root mean square; largest {largest}) of what the host computes in double \
             precision from {from}; {} of the pixels by more than one.{not_finite}",
            percent(self.visible)
        )
    }
}

/// Clamps pixels as a fixed-point target does, if `is_clamped`.
pub(super) fn held(pixels: &[[f64; 3]], is_clamped: bool) -> Vec<[f64; 3]> {
    let held = |color: &[f64; 3]| if is_clamped { color.map(|value| value.clamp(0.0, 1.0)) } else { *color };
    pixels.iter().map(held).collect()
}
