//! First steps of rendering: the light's coefficients (step 1 of section 6), and uncompressed transferred radiance, M_p
//! L, from the raw matrices of one segment after the other.

use rayon::prelude::*;

use crate::all_frequency::Reflectance;
use crate::all_frequency::transfer::transfer_of;
use crate::error::InputError;
use crate::linalg::dot;
use crate::transfer::Vertices;
use crate::transfer::grid::Segmentation;
use crate::transfer::light::{DistantLight, HaarLight, LightTruncation, TruncationPriority};
use crate::transfer::linear_basis::{BasisWidth, LinearBasis};
use crate::transfer::visibility::VisibilityMaps;

/// The coefficients of a light: the `keep` largest by area times magnitude, or all.
pub(in crate::study) fn coefficients(light: &DistantLight, keep: Option<usize>) -> Result<LightTruncation, InputError> {
    let light = HaarLight::new(&light.cube()?, Segmentation::Quarters);
    Ok(light.truncated(keep.unwrap_or(usize::MAX), TruncationPriority::Area))
}

/// Transferred radiance per light and vertex: m rows of three channels. The matrices, which take nearly all the time,
/// are computed only once for all lights.
pub(in crate::study) fn transferred(
    (vertices, maps): (&Vertices, &VisibilityMaps),
    hats: BasisWidth,
    reflectance: &Reflectance,
    lights: &[&HaarLight],
) -> Result<Vec<Vec<[f64; 3]>>, InputError> {
    let (hats, rows) = (LinearBasis::new(hats), reflectance.terms());
    let transfer = transfer_of(vertices, maps, &hats, reflectance);
    let mut radiances = vec![vec![[0.0; 3]; vertices.len() * rows]; lights.len()];
    for segment in transfer.segments() {
        let segment = segment?;
        for (light, radiance) in lights.iter().zip(&mut radiances) {
            let light = [0, 1, 2].map(|channel| light.segment(channel, segment.segment));
            let products = |point: usize| -> Vec<[f64; 3]> {
                let numbers: Vec<f64> = segment.signal.point(point).iter().map(|&value| f64::from(value)).collect();
                let row = |row: &[f64]| light.map(|light| dot(row, light));
                numbers.chunks_exact(light[0].len()).map(row).collect()
            };
            let products: Vec<Vec<[f64; 3]>> = (0..segment.vertices.len()).into_par_iter().map(products).collect();
            for (&vertex, products) in segment.vertices.iter().zip(products) {
                for (into, product) in radiance[vertex as usize * rows..].iter_mut().zip(products) {
                    (0..3).for_each(|channel| into[channel] += product[channel]);
                }
            }
        }
    }
    Ok(radiances)
}
