//! Pixels in f64.

use rayon::prelude::*;
use refsim::device::Profile;

use crate::all_frequency::kernels::ViewNumbers;
use crate::all_frequency::on_card::reference::{pixel_of_colors, pixel_of_products};
use crate::all_frequency::on_card::{ProductPlace, TransferredMesh};
use crate::card::{CardError, SeenPixel, seen_pixels};
use crate::scene::Camera;

/// The view format that a method interpolates; for vertex colors, the view format of the products that they represent.
fn view_of(place: &ProductPlace) -> ViewNumbers {
    if let ProductPlace::Pixels(options) = place { options.view } else { ViewNumbers::default() }
}

/// The front face of the meshes in each pixel by a device's raster; vertex indices continue from mesh to mesh.
pub(super) fn seen_by(
    profile: &Profile,
    meshes: &[TransferredMesh<'_>],
    camera: &Camera,
) -> Result<Vec<Option<SeenPixel>>, CardError> {
    let all = meshes[1..].iter().fold(meshes[0].vertices.clone(), |all, mesh| all.joined(mesh.vertices));
    seen_pixels(profile, all.geometry(), camera)
}

/// The picture of an exact card: exposed, neither clamped nor quantised. 0 where no surface is visible.
pub(super) fn exact_pixels(
    meshes: &[TransferredMesh<'_>],
    seen: &[Option<SeenPixel>],
    place: &ProductPlace,
    eye: [f32; 3],
    exposure: f64,
) -> Vec<[f64; 3]> {
    let of_vertices = matches!(place, ProductPlace::Vertices(_));
    let colors: Vec<_> = meshes.iter().map(|mesh| of_vertices.then(|| mesh.radiance(eye))).collect();
    let pixel = |seen: &Option<SeenPixel>| {
        let Some(SeenPixel { mut corners, weights, .. }) = *seen else { return [0.0; 3] };
        let mut number = 0;
        while corners[0] as usize >= meshes[number].vertices.len() {
            corners = corners.map(|corner| corner - meshes[number].vertices.len() as u32);
            number += 1;
        }
        let radiance = match &colors[number] {
            Some(colors) => pixel_of_colors(colors, corners, weights),
            None => pixel_of_products(&meshes[number], view_of(place), eye, corners, weights),
        };
        radiance.map(|value| exposure * value)
    };
    seen.par_iter().map(pixel).collect()
}
