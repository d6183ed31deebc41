//! Number formats, maps and filters varied one after the other, compared with step 4 in f64 at the same pixels.

use refsim::device::Profile;
use refsim::machine::Executor;
use refsim::texture::TexelFormat;

use super::pixels::{exact_pixels, seen_by};
use crate::all_frequency::kernels::{MapFilter, SetLayout, ViewNumbers};
use crate::all_frequency::on_card::{
    ProductOptions, ProductPlace, RadianceFormat, TransferredMesh, VertexColors, draw,
};
use crate::all_frequency::shade::Multiplies;
use crate::card::{CardError, MeshView};
use crate::scene::Camera;
use crate::study::prt::card::{PictureVariant, PixelErrors};

/// Numbers of bits of G to try.
const BITS: [u32; 5] = [8, 10, 12, 14, 16];
/// Number of texture coordinate sets of ps_2_0.
const SETS: usize = 8;

/// A variant of drawing.
struct Choice {
    axis: &'static str,
    label: String,
    device: &'static str,
    place: ProductPlace,
}

impl Choice {
    fn new(axis: &'static str, label: impl Into<String>, device: &'static str, place: ProductPlace) -> Self {
        Self { axis, label: label.into(), device, place }
    }

    fn pixels(axis: &'static str, label: impl Into<String>, device: &'static str, options: ProductOptions) -> Self {
        Self::new(axis, label, device, ProductPlace::Pixels(options))
    }
}

/// The finest options: G in single precision, filtered by the program; one channel per pass if three do not fit.
fn fine(terms: usize) -> ProductOptions {
    let all = SetLayout { terms, channels: 3, view: ViewNumbers::default() };
    ProductOptions {
        map_format: TexelFormat::Rgba32f,
        filter: MapFilter::Program,
        is_pass_per_channel: all.sets() > SETS,
        ..ProductOptions::default()
    }
}

/// Choices for a reflectance of several terms.
fn choices_of_products(terms: usize) -> Vec<Choice> {
    let fine = fine(terms);
    let mut all = vec![Choice::pixels("none", "fp32 throughout", "ideal-fp32", fine)];
    for device in ["ideal-fp24", "ideal-fp16"] {
        all.push(Choice::pixels("pixel arithmetic", device, device, fine));
    }
    for bits in BITS {
        let options = ProductOptions { map_bits: Some(bits), ..fine };
        all.push(Choice::pixels("bits of G", bits.to_string(), "ideal-fp32", options));
    }
    let half = ProductOptions { map_format: TexelFormat::Rgba16f, ..fine };
    all.push(Choice::pixels("bits of G", "fp16", "ideal-fp32", half));
    let half_radiance = ProductOptions { radiance: RadianceFormat::Fp16, ..fine };
    all.push(Choice::pixels("T_p", "fp16", "ideal-fp32", half_radiance));
    let by_sampler = ProductOptions { filter: MapFilter::Sampler, ..fine };
    all.push(Choice::pixels("filter", "sampler", "ideal-fp32", by_sampler));
    let vector = ProductOptions { view: ViewNumbers::Vector, is_pass_per_channel: true, ..fine };
    all.push(Choice::pixels("view", "vector", "ideal-fp32", vector));
    let is_pass_per_channel = fine.is_pass_per_channel;
    let of_r350 = ProductOptions { is_pass_per_channel, ..ProductOptions::default() };
    let of_nv35 = ProductOptions { map_format: TexelFormat::Rg16Snorm, ..of_r350 };
    let in_8_bits = ProductOptions { map_format: TexelFormat::Rgba8Snorm, ..of_r350 };
    for (choice, device, options) in [
        ("signed 16 bits, sampler", "r350", of_r350),
        ("signed 16 bits, program", "r350", ProductOptions { filter: MapFilter::Program, ..of_r350 }),
        ("fp16, program", "r350", half),
        ("signed 8 bits, sampler", "r350", in_8_bits),
        ("signed 16 bits, sampler, fp32", "nv35", of_nv35),
        ("signed 16 bits, sampler, fp16", "nv35", ProductOptions { is_partial: true, ..of_nv35 }),
        ("signed 8 bits, sampler, fp16", "nv35", ProductOptions { is_partial: true, ..in_8_bits }),
    ] {
        all.push(Choice::pixels("card", format!("{device}: {choice}"), device, options));
    }
    all
}

/// Choices for vertex colors. A diffuse surface, which has one term, has no other choices.
fn choices_of_colors() -> Vec<Choice> {
    let floats = ProductPlace::Vertices(VertexColors::Floats);
    let mut all = vec![Choice::new("vertex colors", "floats, fp32", "ideal-fp32", floats)];
    for device in ["ideal-fp24", "ideal-fp16"] {
        all.push(Choice::new("vertex colors", format!("floats, {device}"), device, floats));
    }
    for device in ["r350", "nv35"] {
        let bytes = ProductPlace::Vertices(VertexColors::Bytes);
        all.push(Choice::new("vertex colors", format!("{device}: bytes"), device, bytes));
    }
    all
}

fn choices(meshes: &[TransferredMesh<'_>]) -> Vec<Choice> {
    let terms = meshes[0].terms();
    let mut all = if terms > 1 { choices_of_products(terms) } else { Vec::new() };
    all.extend(choices_of_colors());
    all
}

/// Number of pictures of [`factored_precision`].
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
    for Choice { axis, label: choice, device, place } in choices(meshes) {
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
