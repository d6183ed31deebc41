//! Number formats, maps and filters of all-frequency transfer, varied one after the other, compared with step 4 in f64
//! at the same pixels.

use rayon::prelude::*;
use refsim::device::Profile;
use refsim::machine::Executor;
use refsim::texture::TexelFormat;

use super::errors::{PictureVariant, PixelErrors};
use crate::all_frequency::kernels::{MapFilter, SetLayout, ViewNumbers};
use crate::all_frequency::on_card::reference::{pixel_of_colors, pixel_of_products};
use crate::all_frequency::on_card::{
    ProductOptions, ProductPlace, RadianceFormat, TransferredMesh, VertexColors, draw,
};
use crate::all_frequency::shade::Multiplies;
use crate::card::{CardError, MeshView, SeenPixel, seen_pixels};
use crate::scene::Camera;

/// Numbers of bits of G to try.
const BITS: [u32; 5] = [8, 10, 12, 14, 16];
/// Number of texture coordinate sets of ps_2_0.
const SETS: usize = 8;

/// A variant of drawing: the varied setting, its value, a device, and where products are computed.
type Choice = (&'static str, String, &'static str, ProductPlace);

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
    // The view that is interpolated; for vertex colors, the view of the products that they represent.
    let (of_vertices, view) = match place {
        ProductPlace::Pixels(options) => (false, options.view),
        ProductPlace::Vertices(_) => (true, ViewNumbers::default()),
    };
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
            None => pixel_of_products(&meshes[number], view, eye, corners, weights),
        };
        radiance.map(|value| exposure * value)
    };
    seen.par_iter().map(pixel).collect()
}

fn choices_of_products(terms: usize) -> Vec<Choice> {
    let all_channels = SetLayout { terms, channels: 3, view: ViewNumbers::default() };
    // One channel per pass if three do not fit.
    let is_pass_per_channel = all_channels.sets() > SETS;
    // G in single precision, filtered by the program.
    let fine = ProductOptions {
        map_format: TexelFormat::Rgba32f,
        filter: MapFilter::Program,
        is_pass_per_channel,
        ..ProductOptions::default()
    };
    let half = ProductOptions { map_format: TexelFormat::Rgba16f, ..fine };
    let of_r350 = ProductOptions { is_pass_per_channel, ..ProductOptions::default() };
    let of_nv35 = ProductOptions { map_format: TexelFormat::Rg16Snorm, ..of_r350 };
    let in_8_bits = ProductOptions { map_format: TexelFormat::Rgba8Snorm, ..of_r350 };
    let bits = BITS.map(|bits| ("bits of G", bits.to_string(), ProductOptions { map_bits: Some(bits), ..fine }));
    let ideal = [
        ("bits of G", "fp16", half),
        ("T_p", "fp16", ProductOptions { radiance: RadianceFormat::Fp16, ..fine }),
        ("filter", "sampler", ProductOptions { filter: MapFilter::Sampler, ..fine }),
        ("view", "vector", ProductOptions { view: ViewNumbers::Vector, is_pass_per_channel: true, ..fine }),
    ];
    let cards = [
        ("signed 16 bits, sampler", "r350", of_r350),
        ("signed 16 bits, program", "r350", ProductOptions { filter: MapFilter::Program, ..of_r350 }),
        ("fp16, program", "r350", half),
        ("signed 8 bits, sampler", "r350", in_8_bits),
        ("signed 16 bits, sampler, fp32", "nv35", of_nv35),
        ("signed 16 bits, sampler, fp16", "nv35", ProductOptions { is_partial: true, ..of_nv35 }),
        ("signed 8 bits, sampler, fp16", "nv35", ProductOptions { is_partial: true, ..in_8_bits }),
    ];
    let arithmetic = ["ideal-fp24", "ideal-fp16"].map(|device| ("pixel arithmetic", device.to_owned(), device, fine));
    let ideal = bits.into_iter().chain(ideal.map(|(axis, label, options)| (axis, label.to_owned(), options)));
    [("none", "fp32 throughout".to_owned(), "ideal-fp32", fine)]
        .into_iter()
        .chain(arithmetic)
        .chain(ideal.map(|(axis, label, options)| (axis, label, "ideal-fp32", options)))
        .chain(cards.map(|(label, device, options)| ("card", format!("{device}: {label}"), device, options)))
        .map(|(axis, label, device, options)| (axis, label, device, ProductPlace::Pixels(options)))
        .collect()
}

/// Choices for vertex colors. A diffuse surface, which has one term, has no other choices.
fn choices_of_colors() -> [Choice; 5] {
    let colors = [
        ("floats, fp32", "ideal-fp32", VertexColors::Floats),
        ("floats, ideal-fp24", "ideal-fp24", VertexColors::Floats),
        ("floats, ideal-fp16", "ideal-fp16", VertexColors::Floats),
        ("r350: bytes", "r350", VertexColors::Bytes),
        ("nv35: bytes", "nv35", VertexColors::Bytes),
    ];
    colors.map(|(label, device, colors)| ("vertex colors", label.to_owned(), device, ProductPlace::Vertices(colors)))
}

fn choices(meshes: &[TransferredMesh<'_>]) -> Vec<Choice> {
    let terms = meshes[0].terms();
    let mut all = if terms > 1 { choices_of_products(terms) } else { Vec::new() };
    all.extend(choices_of_colors());
    all
}

pub(super) fn ways_of_precision(meshes: &[TransferredMesh<'_>]) -> u64 {
    choices(meshes).len() as u64
}

/// Draws variants of meshes, in order, into floats. Compares each picture with the host's in f64 from the same numbers,
/// interpolated by the device's raster. `done` is called with the number of pictures drawn. Fails with [`CardError`] if
/// the meshes do not fit the cards: more than thirty terms, or parts of different kinds.
pub fn factored_precision(
    meshes: &[TransferredMesh<'_>],
    executor: &Executor,
    camera: Camera,
    exposure: f64,
    done: &mut dyn FnMut(u64),
) -> Result<Vec<PictureVariant>, CardError> {
    let view = MeshView { camera, exposure, format: TexelFormat::Rgba32f };
    let mut found = Vec::new();
    for (axis, choice, device, place) in choices(meshes) {
        let profile = Profile::named(device).expect("a device of the project");
        let seen = seen_by(&profile, meshes, &camera)?;
        let drawing = draw(profile, executor.clone(), meshes, place, &view, Multiplies::default())?;
        let expected = exact_pixels(meshes, &seen, &place, camera.eye(), exposure);
        let errors = PixelErrors::of(&seen, &drawing.texels.colors(), &expected);
        let below_zero = Some(drawing.counts.below_zero.unwrap_or(0));
        found.push(PictureVariant { axis, choice, errors, below_zero });
        done(found.len() as u64);
    }
    Ok(found)
}
