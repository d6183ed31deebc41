//! Pictures by cards, compared with f64 pixel by pixel; counts of clamped colors; errors.

use crossbar_systems::all_frequency::Reflectance;
use crossbar_systems::all_frequency::factor::{FactorSampling, Factorization, Lobe, Supersamples};
use crossbar_systems::all_frequency::kernels::{MapFilter, ViewNumbers};
use crossbar_systems::all_frequency::on_card::reference::{pixel_of_colors, pixel_of_products};
use crossbar_systems::all_frequency::on_card::{
    FactoredCard, FactoredDrawing, ProductOptions, ProductPlace, TransferredMesh, VertexColors, draw,
};
use crossbar_systems::all_frequency::shade::{Multiplies, TransferredRadiance};
use crossbar_systems::transfer::synthetic::{hills, signal_at};
use crossbar_systems::transfer::{Tangents, Vertices};
use glam::DVec3;
use refsim::event::Event;
use refsim::machine::ExecutorKind;
use refsim::texture::TexelFormat;

use crate::card::{MeshView, SeenPixel, Texels, seen_pixels};
use crate::device;
use crate::geom::Mesh;
use crate::scene::Camera;
use crate::scene::built::ground::ground;

/// Hills with synthetic transferred radiance, with the number of terms of their reflectance.
struct FactoredHills {
    vertices: Vertices,
    reflectance: Reflectance,
    transferred: TransferredRadiance,
}

const COLORS: [[f64; 3]; 1] = [[0.9, 0.6, 0.3]];

impl FactoredHills {
    fn new(reflectance: Reflectance) -> Self {
        Self::of(&hills(7), reflectance)
    }

    fn of(mesh: &Mesh, reflectance: Reflectance) -> Self {
        let vertices = Vertices::new(mesh, Tangents::Along(DVec3::X)).expect("vertices");
        let terms = reflectance.terms();
        let place = |at: usize| vertices.positions()[at].map(f64::from);
        let signal = signal_at(vertices.len(), 3 * terms, 8, place);
        let transferred = TransferredRadiance::new(terms, signal.values().as_chunks().0.to_vec());
        Self { vertices, reflectance, transferred }
    }

    fn glossy(terms: usize) -> Self {
        let sampling = FactorSampling { side: 8, supersamples: Supersamples::NONE, ..FactorSampling::default() };
        let table = sampling.table(&Lobe::schlick(0.3, 0.5, 0.8), &mut |_, _| ()).expect("a table");
        Self::new(Reflectance::Factored(Factorization::new(&table, terms).expect("terms").factors(terms)))
    }

    fn mesh(&self) -> TransferredMesh<'_> {
        let Self { vertices, reflectance, transferred } = self;
        TransferredMesh { vertices, reflectance, colors: &COLORS, transferred }
    }

    fn draw(&self, name: &str, place: ProductPlace, format: TexelFormat) -> FactoredDrawing {
        let view = MeshView { camera: camera(), exposure: 0.7, format };
        draw(device(name), ExecutorKind::Batch, &[self.mesh()], place, &view, Multiplies::default())
            .unwrap_or_else(|e| panic!("{name}, {place:?}: {e}"))
    }

    /// The largest difference between a picture and step 4 in f64, relative to the largest radiance; and the number of
    /// pixels.
    fn error(&self, name: &str, place: ProductPlace, drawing: &Texels) -> (f64, usize) {
        let seen = seen_pixels(&device(name), self.vertices.geometry(), &camera()).expect("pixels");
        let colors = self.mesh().radiance(camera().eye());
        let (mut worst, mut largest, mut count) = (0.0_f64, 0.0_f64, 0);
        for (texel, seen) in drawing.texels.iter().zip(&seen) {
            assert_eq!(texel[3] != 0.0, seen.is_some(), "what is covered");
            let Some(SeenPixel { corners, weights, .. }) = *seen else { continue };
            let expected = match place {
                ProductPlace::Vertices(_) => pixel_of_colors(&colors, corners, weights),
                ProductPlace::Pixels(options) => {
                    pixel_of_products(&self.mesh(), options.view, camera().eye(), corners, weights)
                }
            };
            for (found, expected) in texel.iter().zip(expected) {
                worst = worst.max((f64::from(*found) - 0.7 * expected).abs());
                largest = largest.max((0.7 * expected).abs());
            }
            count += 1;
        }
        (worst / largest, count)
    }
}

/// The camera looks from the side, so that hills hide each other and views come near the horizon.
fn camera() -> Camera {
    Camera::new([0.6, -2.2, 1.6], [0.0; 3], [0.0, 0.0, 1.0], 0.5, 44, 36).expect("a camera")
}

/// Float maps of G, filtered by the program, which leaves only rounding errors.
fn exact() -> ProductOptions {
    ProductOptions { map_format: TexelFormat::Rgba32f, filter: MapFilter::Program, ..ProductOptions::default() }
}

const FLOATS: TexelFormat = TexelFormat::Rgba32f;

#[test]
fn products_per_pixel_are_step_4_of_what_is_interpolated() {
    let hills = FactoredHills::glossy(10);
    for (view, is_pass_per_channel) in
        [(ViewNumbers::Coordinates, false), (ViewNumbers::Coordinates, true), (ViewNumbers::Vector, true)]
    {
        let options = ProductOptions { view, is_pass_per_channel, ..exact() };
        let place = ProductPlace::Pixels(options);
        let drawing = hills.draw("ideal-fp32", place, FLOATS);
        let (error, pixels) = hills.error("ideal-fp32", place, &drawing.texels);
        assert!(error < 4e-6 && pixels > 400, "{options:?}: {error} over {pixels} pixels");
    }
    for terms in [1, 2, 3, 4, 5, 7, 8, 9] {
        let hills = FactoredHills::glossy(terms);
        let place = ProductPlace::Pixels(exact());
        let (error, _) = hills.error("ideal-fp32", place, &hills.draw("ideal-fp32", place, FLOATS).texels);
        assert!(error < 4e-6, "{terms} terms: {error}");
    }
    // From below all faces are backs, which are not drawn.
    let below = Camera::new([0.6, -2.2, -1.6], [0.0; 3], [0.0, 0.0, 1.0], 0.5, 44, 36).expect("a camera");
    let (view, place) = (MeshView { camera: below, exposure: 0.7, format: FLOATS }, ProductPlace::Pixels(exact()));
    let mut card =
        FactoredCard::new(device("ideal-fp32"), ExecutorKind::Batch, &[hills.mesh()], place).expect("a card");
    assert!(card.view_texels(&view).expect("a picture").texels.iter().all(|texel| *texel == [0.0; 4]));
}

#[test]
fn colors_of_vertices_are_interpolated() {
    let hills = FactoredHills::glossy(10);
    let place = ProductPlace::Vertices(VertexColors::Floats);
    let drawing = hills.draw("r350", place, FLOATS);
    let (error, pixels) = hills.error("r350", place, &drawing.texels);
    assert!(error < 2e-5 && pixels > 400, "{error}");
    let diffuse = FactoredHills::new(Reflectance::Diffuse);
    let pixels = ProductPlace::Pixels(ProductOptions::default());
    let (error, _) = diffuse.error("r350", pixels, &diffuse.draw("r350", pixels, FLOATS).texels);
    assert!(error < 2e-5, "one term: {error}");
}

/// A plane with another reflectance cuts the hills: each pixel shows the nearer mesh, with one pass or three.
#[test]
fn meshes_hide_each_other() {
    let [hills, plane] =
        [FactoredHills::glossy(5), FactoredHills::of(&ground(4, DVec3::ZERO, 1.0), Reflectance::Diffuse)];
    let (meshes, first) = ([hills.mesh(), plane.mesh()], hills.vertices.len() as u32);
    let joined = hills.vertices.joined(&plane.vertices);
    let seen = seen_pixels(&device("ideal-fp32"), joined.geometry(), &camera()).expect("pixels");
    let (view, work) = (MeshView { camera: camera(), exposure: 0.7, format: FLOATS }, Multiplies::default());
    for is_pass_per_channel in [false, true] {
        let place = ProductPlace::Pixels(ProductOptions { is_pass_per_channel, ..exact() });
        let drawing = draw(device("ideal-fp32"), ExecutorKind::Batch, &meshes, place, &view, work).expect("a picture");
        let mut shown = [0; 2];
        for (texel, seen) in drawing.texels.texels.iter().zip(&seen) {
            let Some(SeenPixel { corners, weights, .. }) = *seen else { continue };
            let number = usize::from(corners[0] >= first);
            shown[number] += 1;
            let corners = if number == 1 { corners.map(|corner| corner - first) } else { corners };
            let eye = camera().eye();
            let expected = pixel_of_products(&meshes[number], ViewNumbers::Coordinates, eye, corners, weights);
            for (found, expected) in texel.iter().zip(expected) {
                assert!((f64::from(*found) - 0.7 * expected).abs() < 1e-5, "{found}, not {expected}");
            }
        }
        assert!(shown.iter().all(|&pixels| pixels > 100), "{shown:?}");
        let sent = |event: &Event| if let Event::Upload { bytes, .. } = event { *bytes } else { 0 };
        let bytes = drawing.log.iter().map(sent).sum::<u64>();
        assert_eq!(bytes, 60 * u64::from(first) + 12 * plane.vertices.len() as u64);
    }
}

#[test]
fn what_is_clamped_is_counted() {
    let hills = FactoredHills::glossy(10);
    let place = ProductPlace::Pixels(exact());
    let [floats, bytes] = [FLOATS, TexelFormat::Bgra8].map(|format| hills.draw("r350", place, format));
    assert!(floats.counts.below_zero.is_some_and(|below| below > 0));
    assert_eq!(floats.counts, bytes.counts);
    assert!(bytes.texels.texels.iter().flatten().all(|&value| value >= 0.0));
    assert_eq!(Some(&floats.texels), bytes.signed.as_ref());
    let expected = hills.mesh().radiance(camera().eye());
    let negative = expected.iter().filter(|color| color.iter().any(|&value| value < 0.0)).count() as u64;
    for (name, colors) in [("nv25", VertexColors::Bytes), ("r350", VertexColors::Floats)] {
        let counts = hills.draw(name, ProductPlace::Vertices(colors), TexelFormat::Bgra8).counts;
        assert_eq!(counts.vertices_below_zero, Some(negative), "{name}");
        assert_eq!(counts.below_zero.is_some(), name == "r350", "{name} has no target of floats");
    }
}

#[test]
fn what_does_not_fit_is_refused() {
    let message = |name: &str, terms: usize, options: ProductOptions| {
        let hills = FactoredHills::glossy(terms);
        let card = FactoredCard::new(device(name), ExecutorKind::Batch, &[hills.mesh()], ProductPlace::Pixels(options));
        card.map(|_| ()).expect_err("refused").to_string()
    };
    let options = ProductOptions::default();
    let vector = ProductOptions { view: ViewNumbers::Vector, ..options };
    let refused = message("r350", 10, vector);
    assert!(refused.contains("10 terms of 3 channels and 3 numbers of the view need 9 sets"), "{refused}");
    assert!(refused.contains("`r350` has 8 (limits.texture_coordinates)"), "{refused}");
    assert!(message("r350", 11, options).contains("need 9 sets"));
    let half = ProductOptions { map_format: TexelFormat::Rgba16f, ..options };
    assert!(message("r350", 10, half).contains("limits.float_filtering"));
    let by_program = ProductOptions { filter: MapFilter::Program, ..half };
    assert!(message("nv35", 10, by_program).contains("as rectangles only"));
    assert!(message("nv35", 10, options).contains("rgba16s"), "{}", message("nv35", 10, options));
    assert!(message("nv25", 10, options).contains("`nv25` refuses the product per pixel: it runs no `ps_2_0`"));
    let unsigned = ProductOptions { map_format: TexelFormat::Rgba16, ..options };
    assert!(message("r350", 10, unsigned).contains("signed fractions"));
    let two = ProductOptions { map_format: TexelFormat::Rg16Snorm, filter: MapFilter::Program, ..options };
    assert!(message("r350", 10, two).contains("by the sampler alone"));
    let bits = ProductOptions { map_bits: Some(1), ..options };
    assert!(message("r350", 10, bits).contains("2 to 24 bits of G, found 1"));
    let hills = FactoredHills::glossy(3);
    let fewer = TransferredRadiance::new(2, vec![[0.0; 3]; 2 * hills.vertices.len()]);
    let mesh = TransferredMesh { transferred: &fewer, ..hills.mesh() };
    let place = ProductPlace::Pixels(options);
    let error =
        FactoredCard::new(device("r350"), ExecutorKind::Batch, &[mesh], place).map(|_| ()).expect_err("refused");
    assert_eq!(error.to_string(), "expected 3 rows, one per term, found 2");
    let bright = TransferredRadiance::new(3, vec![[3e38; 3]; 3 * hills.vertices.len()]);
    let mesh = TransferredMesh { transferred: &bright, ..hills.mesh() };
    let mut card = FactoredCard::new(device("r350"), ExecutorKind::Batch, &[mesh], place).expect("a card");
    let view = |exposure| MeshView { camera: camera(), exposure, format: FLOATS };
    for (exposure, expected) in [(1e3, "radiance that its format holds"), (-1.0, "an exposure of 0 to 1e30")] {
        let refused = card.view_texels(&view(exposure)).expect_err("refused").to_string();
        assert!(refused.contains(expected), "{refused}");
    }
}
