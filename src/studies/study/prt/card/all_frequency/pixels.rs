//! Pixels in f64.

use rayon::prelude::*;

use crate::all_frequency::kernels::ViewNumbers;
use crate::all_frequency::on_card::reference::{pixel_of_colors, pixel_of_products, vertex_radiance};
use crate::all_frequency::on_card::{ProductPlace, TransferredMesh};
use crate::card::SeenPixel;

/// The view format that a method interpolates; for vertex colors, the view format of the products that they represent.
fn view_of(place: &ProductPlace) -> ViewNumbers {
    if let ProductPlace::Pixels(options) = place { options.view } else { ViewNumbers::default() }
}

/// The picture of an exact card: exposed, neither clamped nor quantised. Pixels without a surface are 0.
pub(super) fn exact_pixels(
    mesh: &TransferredMesh<'_>,
    seen: &[Option<SeenPixel>],
    place: &ProductPlace,
    eye: [f32; 3],
    exposure: f64,
) -> Vec<[f64; 3]> {
    let colors = matches!(place, ProductPlace::Vertices(_)).then(|| vertex_radiance(mesh, eye));
    let pixel = |seen: &Option<SeenPixel>| {
        let Some(SeenPixel { corners, weights, .. }) = *seen else { return [0.0; 3] };
        let radiance = match &colors {
            Some(colors) => pixel_of_colors(colors, corners, weights),
            None => pixel_of_products(mesh, view_of(place), eye, corners, weights),
        };
        radiance.map(|value| exposure * value)
    };
    seen.par_iter().map(pixel).collect()
}
