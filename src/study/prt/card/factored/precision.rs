//! All-frequency transfer by a card: one thing after the other made coarse, against step 4 in f64 of the same pixels.

use refsim::device::Profile;
use refsim::machine::Executor;
use refsim::texture::TexelFormat;

use crate::prt::all_frequency::kernels::{MapFilter, ViewNumbers};
use crate::prt::all_frequency::on_card::reference::pixel_of_products;
use crate::prt::all_frequency::on_card::{
    FactoredCardError, ProductOptions, ProductPlace, RadianceFormat, SeenPixel, TransferredMesh, draw, seen_pixels,
};
use crate::prt::all_frequency::shade::Multiplies;
use crate::prt::on_card::PrtView;
use crate::report::{Cell, Table};
use crate::scene::Camera;

/// Steps of a picture of 8 bits.
const STEPS: f64 = 255.0;
/// Bits of G that are tried.
const BITS: [u32; 5] = [8, 10, 12, 14, 16];

/// A way to draw, and how far its picture is off.
#[derive(Clone, Debug, PartialEq)]
pub struct FactoredPrecision {
    /// Of what it is a choice.
    pub axis: &'static str,
    /// The choice.
    pub choice: String,
    /// The device.
    pub device: &'static str,
    /// How products are made.
    pub options: ProductOptions,
    /// Root mean square and largest difference of a channel, in 255ths of white.
    pub off_255ths: [f64; 2],
    /// Share of the pixels that show the mesh of which a channel is off by more than one 255th.
    pub visible: f64,
    /// Pixels below 0.
    pub below_zero: u64,
}

/// Nothing made coarse: G in single precision, filtered by the program.
fn fine() -> ProductOptions {
    ProductOptions { map_format: TexelFormat::Rgba32f, filter: MapFilter::Program, ..ProductOptions::default() }
}

fn choices() -> Vec<(&'static str, String, &'static str, ProductOptions)> {
    let mut all = vec![("none", "fp32 throughout".to_owned(), "ideal-fp32", fine())];
    for device in ["ideal-fp24", "ideal-fp16"] {
        all.push(("pixel arithmetic", device.to_owned(), device, fine()));
    }
    for bits in BITS {
        let options = ProductOptions { map_bits: Some(bits), ..fine() };
        all.push(("bits of G", bits.to_string(), "ideal-fp32", options));
    }
    let half = ProductOptions { map_format: TexelFormat::Rgba16f, ..fine() };
    all.push(("bits of G", "fp16".to_owned(), "ideal-fp32", half));
    all.push(("T_p", "fp16".to_owned(), "ideal-fp32", ProductOptions { radiance: RadianceFormat::Fp16, ..fine() }));
    let by_sampler = ProductOptions { filter: MapFilter::Sampler, ..fine() };
    all.push(("filter", "sampler".to_owned(), "ideal-fp32", by_sampler));
    let vector = ProductOptions { view: ViewNumbers::Vector, is_pass_per_channel: true, ..fine() };
    all.push(("view", "vector".to_owned(), "ideal-fp32", vector));
    let of_r350 = ProductOptions::default();
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
        all.push(("card", format!("{device}: {choice}"), device, options));
    }
    all
}

/// Draws a mesh into floats in many ways, and compares each picture with what the host computes in f64 of the same
/// numbers, interpolated by the device's raster.
///
/// # Errors
/// [`FactoredCardError`] for meshes that do not fit the cards: more than ten terms, parts that do not go together.
pub fn factored_precision(
    mesh: TransferredMesh<'_>,
    executor: &Executor,
    (camera, exposure): (Camera, f64),
) -> Result<Vec<FactoredPrecision>, FactoredCardError> {
    let view = PrtView { camera, exposure, format: TexelFormat::Rgba32f };
    let mut found = Vec::new();
    for (axis, choice, device, options) in choices() {
        let profile = Profile::named(device)?;
        let seen = seen_pixels(&profile, mesh.vertices, &camera)?;
        let place = ProductPlace::Pixels(options);
        let drawing = draw(mesh, (profile, executor.clone()), place, &view, Multiplies::default())?;
        let expected = |&SeenPixel { corners, weights }: &SeenPixel| {
            pixel_of_products(&mesh, (options.view, camera.eye()), corners, weights).map(|value| exposure * value)
        };
        let off = drawing.texels.texels.iter().zip(&seen).filter_map(|(texel, seen)| {
            let expected = expected(seen.as_ref()?);
            Some([0, 1, 2].map(|channel| STEPS * (f64::from(texel[channel]) - expected[channel])))
        });
        let off: Vec<[f64; 3]> = off.collect();
        let (pixels, all) = (off.len().max(1) as f64, off.as_flattened());
        let largest = all.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        let rms = (all.iter().map(|value| value * value).sum::<f64>() / (3.0 * pixels)).sqrt();
        let visible = off.iter().filter(|pixel| pixel.iter().any(|value| value.abs() > 1.0)).count() as f64 / pixels;
        let below_zero = drawing.counts.below_zero.unwrap_or(0);
        found.push(FactoredPrecision {
            axis,
            choice,
            device,
            options,
            off_255ths: [rms, largest],
            visible,
            below_zero,
        });
    }
    Ok(found)
}

/// A row per way.
pub fn factored_precision_table(ways: &[FactoredPrecision]) -> Table {
    let mut table = Table::of("What shows", "what choice rms_255ths largest_255ths visible_% below_zero");
    for way in ways {
        table.push([
            way.axis.into(),
            way.choice.clone().into(),
            Cell::measured(way.off_255ths[0]),
            Cell::measured(way.off_255ths[1]),
            Cell::percent(100.0 * way.visible),
            way.below_zero.into(),
        ]);
    }
    table
}
