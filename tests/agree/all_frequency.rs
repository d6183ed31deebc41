//! All-frequency transfer: pictures by colors of vertices and by products per pixel, on every executor.

use crossbar::all_frequency::Reflectance;
use crossbar::all_frequency::factor::{FactorSampling, Factorization, Lobe, Supersamples};
use crossbar::all_frequency::kernels::{MapFilter, ViewNumbers};
use crossbar::all_frequency::on_card::{
    FactoredCard, ProductOptions, ProductPlace, RadianceFormat, TransferredMesh, VertexColors,
};
use crossbar::all_frequency::shade::TransferredRadiance;
use crossbar::geom::Mesh;
use crossbar::scene::built::ground::ground;
use crossbar::transfer::synthetic::{hills, signal_at};
use crossbar::transfer::{Tangents, Vertices};
use glam::DVec3;
use refsim::texture::TexelFormat;

use crate::rules::profile;
use crate::system::pictures_agree;

/// Hills with made-up transferred radiance.
struct Hills {
    vertices: Vertices,
    reflectance: Reflectance,
    transferred: TransferredRadiance,
}

impl Hills {
    fn new(terms: usize) -> Self {
        let sampling = FactorSampling { side: 8, supersamples: Supersamples::NONE, ..FactorSampling::default() };
        let table = sampling.table(&Lobe::schlick(0.3, 0.5, 0.8), &mut |_, _| ()).expect("a table");
        let factors = Factorization::new(&table, terms).expect("terms").factors(terms);
        Self::of(Reflectance::Factored(factors))
    }

    fn of(reflectance: Reflectance) -> Self {
        Self::on(&hills(6), reflectance)
    }

    fn on(mesh: &Mesh, reflectance: Reflectance) -> Self {
        let vertices = Vertices::new(mesh, Tangents::Any).expect("vertices");
        let place = |at: usize| vertices.positions()[at].map(f64::from);
        let signal = signal_at(vertices.len(), 3 * reflectance.terms(), 5, place);
        let transferred = TransferredRadiance::new(reflectance.terms(), signal.values().as_chunks().0.to_vec());
        Self { vertices, reflectance, transferred }
    }

    fn mesh(&self) -> TransferredMesh<'_> {
        let Self { vertices, reflectance, transferred } = self;
        TransferredMesh { vertices, reflectance, colors: &[[0.9, 0.5, 0.7]], transferred }
    }

    fn agrees(&self, device: &str, format: TexelFormat, place: ProductPlace) {
        agree(&[self.mesh()], device, format, place);
    }
}

fn agree(meshes: &[TransferredMesh<'_>], device: &str, format: TexelFormat, place: ProductPlace) {
    pictures_agree(
        &format!("{} meshes, {} terms, {device}, {format:?}, {place:?}", meshes.len(), meshes[0].terms()),
        format,
        |executor| FactoredCard::new(profile(device), executor, meshes, place),
        |card, view| card.view_texels(view),
    );
}

/// A model of ten terms, and a ground of one that hides a part of it.
#[test]
fn a_model_and_its_ground_are_the_same_everywhere() {
    let (hills, ground) = (Hills::new(10), Hills::on(&ground(3, DVec3::ZERO, 1.0), Reflectance::Diffuse));
    let per_channel = ProductOptions { is_pass_per_channel: true, ..ProductOptions::default() };
    for (format, place) in [
        (TexelFormat::Rgba32f, ProductPlace::Pixels(per_channel)),
        (TexelFormat::Bgra8, ProductPlace::Vertices(VertexColors::Bytes)),
    ] {
        agree(&[hills.mesh(), ground.mesh()], "r350", format, place);
    }
}

#[test]
fn colors_of_vertices_are_the_same_everywhere() {
    let hills = Hills::new(10);
    for (device, colors, format) in [
        ("r350", VertexColors::Bytes, TexelFormat::Bgra8),
        ("nv25", VertexColors::Bytes, TexelFormat::Bgra8),
        ("r200", VertexColors::Bytes, TexelFormat::Bgra8),
        ("r350", VertexColors::Floats, TexelFormat::Rgba32f),
        ("nv35", VertexColors::Floats, TexelFormat::Rgba16f),
    ] {
        hills.agrees(device, format, ProductPlace::Vertices(colors));
    }
    let pixels = ProductPlace::Pixels(ProductOptions::default());
    Hills::of(Reflectance::Diffuse).agrees("r350", TexelFormat::Bgra8, pixels);
}

#[test]
fn products_per_pixel_are_the_same_everywhere() {
    let hills = Hills::new(10);
    let options = ProductOptions::default();
    let per_channel = ProductOptions { view: ViewNumbers::Vector, is_pass_per_channel: true, ..options };
    let by_program = ProductOptions { filter: MapFilter::Program, ..options };
    let in_8_bits = ProductOptions { map_format: TexelFormat::Rgba8Snorm, ..options };
    for (device, format, options) in [
        ("r350", TexelFormat::Bgra8, options),
        ("r350", TexelFormat::Rgba32f, per_channel),
        ("r350", TexelFormat::Rgba16f, ProductOptions { map_format: TexelFormat::Rgba16f, ..by_program }),
        ("r350", TexelFormat::Rgba16, by_program),
        ("r350", TexelFormat::Bgra8, ProductOptions { radiance: RadianceFormat::Fp16, ..options }),
        ("nv35", TexelFormat::Rgba32f, ProductOptions { map_format: TexelFormat::Rg16Snorm, ..options }),
        ("nv35", TexelFormat::Bgra8, ProductOptions { is_partial: true, ..in_8_bits }),
        ("ideal-fp16", TexelFormat::Rgba32f, ProductOptions { map_bits: Some(10), ..by_program }),
        ("ideal-fp32", TexelFormat::Rgba32f, ProductOptions { map_format: TexelFormat::Rgba32f, ..options }),
    ] {
        hills.agrees(device, format, ProductPlace::Pixels(options));
    }
    for terms in [2, 3, 5, 8] {
        Hills::new(terms).agrees("r350", TexelFormat::Rgba32f, ProductPlace::Pixels(options));
    }
}
