//! Pixels in f64, and how far others are off.

use rayon::prelude::*;

use crate::all_frequency::kernels::ViewNumbers;
use crate::all_frequency::on_card::reference::{pixel_of_colors, pixel_of_products, vertex_radiance};
use crate::all_frequency::on_card::{ProductPlace, SeenPixel, TransferredMesh};
use crate::report::Cell;

/// Steps of a picture of 8 bits.
const STEPS: f64 = 255.0;

/// How far pixels that show the mesh are off.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PixelErrors {
    /// Root mean square and largest difference of a channel, in 255ths of white.
    pub off_255ths: [f64; 2],
    /// Share of the pixels of which a channel is off by more than one 255th.
    pub visible: f64,
}

impl PixelErrors {
    /// Of pixels, row by row, against others; those that show nothing do not count.
    pub(in crate::study::prt::card) fn of(
        seen: &[Option<SeenPixel>],
        found: &[[f64; 3]],
        expected: &[[f64; 3]],
    ) -> Self {
        let shown = seen.iter().zip(found.iter().zip(expected)).filter(|(seen, _)| seen.is_some());
        let off: Vec<[f64; 3]> =
            shown.map(|(_, (a, b))| [0, 1, 2].map(|channel| STEPS * (a[channel] - b[channel]))).collect();
        let (pixels, all) = (off.len().max(1) as f64, off.as_flattened());
        let largest = all.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        let rms = (all.iter().map(|value| value * value).sum::<f64>() / (3.0 * pixels)).sqrt();
        let visible = off.iter().filter(|pixel| pixel.iter().any(|value| value.abs() > 1.0)).count() as f64 / pixels;
        Self { off_255ths: [rms, largest], visible }
    }

    /// Cells of a table: root mean square, largest, percent of the pixels.
    pub(in crate::study::prt::card) fn cells(&self) -> [Cell; 3] {
        let [rms, largest] = self.off_255ths.map(Cell::measured);
        [rms, largest, Cell::percent(100.0 * self.visible)]
    }
}

/// The view that a way interpolates; vertex colors: that of products, which they stand for.
fn view_of(place: &ProductPlace) -> ViewNumbers {
    if let ProductPlace::Pixels(options) = place { options.view } else { ViewNumbers::default() }
}

/// What a card that rounds nothing would draw: exposed, neither clamped nor quantised. 0 where nothing is seen.
pub(super) fn exact_pixels(
    mesh: &TransferredMesh<'_>,
    seen: &[Option<SeenPixel>],
    place: &ProductPlace,
    (eye, exposure): ([f32; 3], f64),
) -> Vec<[f64; 3]> {
    let colors = matches!(place, ProductPlace::Vertices(_)).then(|| vertex_radiance(mesh, eye));
    let pixel = |seen: &Option<SeenPixel>| {
        let Some(SeenPixel { corners, weights, .. }) = *seen else { return [0.0; 3] };
        let radiance = match &colors {
            Some(colors) => pixel_of_colors(colors, corners, weights),
            None => pixel_of_products(mesh, (view_of(place), eye), corners, weights),
        };
        radiance.map(|value| exposure * value)
    };
    seen.par_iter().map(pixel).collect()
}
