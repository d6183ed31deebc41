//! Pictures of bi-scale transfer on cards, compared with f64; counts of a frame; errors.

use crossbar_systems::bi_scale::kernels::BlockEdges;
use crossbar_systems::bi_scale::on_card::{BiScaleCard, DisplayOptions, LightFormat, TexturedMesh, corner_coordinates};
use crossbar_systems::bi_scale::texture::BidirectionalTexture;
use crossbar_systems::transfer::synthetic::hills;
use crossbar_systems::transfer::{Tangents, Vertices};
use glam::DVec3;
use refsim::device::Profile;
use refsim::machine::ExecutorKind;
use refsim::texture::TexelFormat;

use super::{FLOATS, texture};
use crate::card::{MeshView, Texels, seen_pixels};
use crate::device;
use crate::geom::random::CounterRng;
use crate::scene::Camera;

/// Hills with a texture given by a formula, and synthetic local light.
struct Hills {
    vertices: Vertices,
    coordinates: Vec<[[f32; 2]; 3]>,
    textures: Vec<BidirectionalTexture>,
    texture_of: Vec<u32>,
    local: Vec<[f32; 3]>,
}

impl Hills {
    fn new(texture: BidirectionalTexture) -> Self {
        let vertices = Vertices::new(&hills(5), Tangents::Along(DVec3::X)).expect("vertices");
        let at = |vertex: u32| {
            let [x, y, _] = vertices.positions()[vertex as usize];
            [1.3 * x + 0.137, 1.1 * y - 0.371]
        };
        let coordinates = vertices.triangles().iter().map(|corners| corners.map(at)).collect();
        let random = CounterRng::new(21);
        let numbers = vertices.len() * texture.light().directions().len();
        let local = (0..numbers as u64).map(|at| [0, 1, 2].map(|channel| (0.1 * random.unit(at, channel, 0)) as f32));
        let texture_of = vec![0; vertices.triangles().len()];
        Self { local: local.collect(), coordinates, textures: vec![texture], texture_of, vertices }
    }

    fn mesh(&self) -> TexturedMesh<'_> {
        let Self { vertices, coordinates, textures, texture_of, .. } = self;
        TexturedMesh { vertices, coordinates, textures, texture_of }
    }

    fn draw(&self, profile: &Profile, options: DisplayOptions, format: TexelFormat) -> Texels {
        let mut card = BiScaleCard::new(profile.clone(), ExecutorKind::Batch, self.mesh(), options)
            .unwrap_or_else(|e| panic!("{options:?}: {e}"));
        let view = MeshView { camera: camera(), exposure: 0.7, format };
        card.view_texels(&self.local, &view).unwrap_or_else(|e| panic!("{options:?}: {e}"))
    }

    /// Root mean square and largest difference from equation 3 in f64, relative to the largest pixel.
    fn error(&self, profile: &Profile, drawing: &Texels) -> [f64; 2] {
        let seen = seen_pixels(profile, self.vertices.geometry(), &camera()).expect("pixels");
        let local: Vec<[f64; 3]> = self.local.iter().map(|rgb| rgb.map(f64::from)).collect();
        let (mut worst, mut largest, mut squares, mut count) = (0.0_f64, 0.0_f64, 0.0, 0);
        for (texel, seen) in drawing.texels.iter().zip(&seen) {
            assert_eq!(texel[3] != 0.0, seen.is_some(), "what is covered");
            let Some(seen) = seen else { continue };
            let expected = self.mesh().pixel(&local, camera().eye(), seen);
            for (found, expected) in texel.iter().zip(expected) {
                let off = (f64::from(*found) - 0.7 * expected).abs();
                (worst, largest, squares) = (worst.max(off), largest.max(0.7 * expected), squares + off * off);
            }
            count += 3;
        }
        assert!(count > 1000, "{count} numbers");
        [(squares / f64::from(count)).sqrt() / largest, worst / largest]
    }
}

/// The camera looks from the side, so that hills hide each other and views come near and below the horizon.
fn camera() -> Camera {
    Camera::new([0.6, -2.2, 1.6], [0.0; 3], [0.0, 0.0, 1.0], 0.5, 44, 36).expect("a camera")
}

/// A texture with a uniform color per patch, so that only view, light and their sums matter.
fn flat(views: usize, lights: usize) -> BidirectionalTexture {
    let random = CounterRng::new(22);
    texture(4, views, lights, |at| [0, 1, 2].map(|channel| random.unit((at / 16) as u64, channel, 0) as f32))
}

fn rough(size: usize, views: usize, lights: usize) -> BidirectionalTexture {
    let random = CounterRng::new(23);
    texture(size, views, lights, |at| [0, 1, 2].map(|channel| random.unit(at as u64, channel, 0) as f32))
}

fn floats(edges: BlockEdges) -> DisplayOptions {
    DisplayOptions { edges, texture: FLOATS, local: LightFormat::Fp32 }
}

#[test]
fn pictures_are_equation_3_of_what_is_interpolated() {
    for (name, views, lights) in
        [("ideal-fp32", 5, 3), ("gt200", 12, 3), ("gt200", 1, 1), ("gt200", 4, 2), ("ideal-fp32", 3, 5)]
    {
        let hills = Hills::new(flat(views, lights));
        let options = floats(BlockEdges::default());
        let [_, error] = hills.error(&device(name), &hills.draw(&device(name), options, FLOATS));
        assert!(error < 3e-6, "{name}, {views}, {lights}: {error}");
    }
    // With different texels, the sampler's weights matter, whose number of bits is given.
    for bits in [8, 12] {
        let mut profile = device("ideal-fp32");
        profile.rules.filter_fraction_bits = bits;
        let hills = Hills::new(rough(8, 4, 3));
        let [_, error] = hills.error(&profile, &hills.draw(&profile, floats(BlockEdges::Wrapped), FLOATS));
        let bound = 3e-6 + 1.0 / f64::from(1_u32 << bits);
        assert!(error < bound, "{bits} bits: {error} of {bound}");
    }
    // From below all faces are backs, which are not drawn.
    let (hills, options) = (Hills::new(flat(1, 1)), floats(BlockEdges::default()));
    let below = Camera::new([0.6, -2.2, -1.6], [0.0; 3], [0.0, 0.0, 1.0], 0.5, 44, 36).expect("a camera");
    let view = MeshView { camera: below, exposure: 0.7, format: FLOATS };
    let mut card = BiScaleCard::new(device("gt200"), ExecutorKind::Batch, hills.mesh(), options).expect("a card");
    assert!(card.view_texels(&hills.local, &view).expect("a picture").texels.iter().all(|texel| *texel == [0.0; 4]));
}

/// Triangles show their own textures, of any sizes and views; a pixel belongs to one texture. A texture that no
/// triangle uses costs nothing.
#[test]
fn triangles_show_their_own_textures() {
    let mut hills = Hills::new(flat(5, 4));
    let other = CounterRng::new(24);
    let size = |at: usize| [0, 1, 2].map(|channel| other.unit((at / 4) as u64, channel, 0) as f32);
    hills.textures.extend([texture(2, 3, 4, size), flat(2, 4)]);
    hills.texture_of = (0..50).map(|triangle| u32::from(triangle % 3 == 1)).collect();
    let options = floats(BlockEdges::default());
    let profile = device("gt200");
    let drawing = hills.draw(&profile, options, FLOATS);
    let [_, error] = hills.error(&profile, &drawing);
    assert!(error < 3e-6, "{error}");
    let counts =
        BiScaleCard::new(profile.clone(), ExecutorKind::Batch, hills.mesh(), options).expect("a card").counts();
    assert_eq!((counts.passes, counts.draws), (2, 4));
    hills.texture_of = vec![0; 50];
    let one = hills.draw(&profile, options, FLOATS);
    let differ = one.texels.iter().zip(&drawing.texels).filter(|(a, b)| a != b).count();
    assert!((100..1400).contains(&differ), "{differ}");
}

#[test]
fn fewer_bits_show() {
    let hills = Hills::new(rough(8, 4, 4));
    let fine = floats(BlockEdges::Wrapped);
    // The sampler's weights have more bits than the card's, so that their rounding does not hide other errors.
    let mut profile = device("gt200");
    profile.rules.filter_fraction_bits = 12;
    let rms = |options, format| hills.error(&profile, &hills.draw(&profile, options, format))[0];
    let best = rms(fine, FLOATS);
    let texture = |texture| rms(DisplayOptions { texture, ..fine }, FLOATS);
    let local = |local| rms(DisplayOptions { local, ..fine }, FLOATS);
    for (what, bytes, half, low, high) in [
        ("texture", texture(TexelFormat::Rgba8), texture(TexelFormat::Rgba16f), 1e-4, 4e-3),
        ("local light", local(LightFormat::Bytes), local(LightFormat::Fp16), 1e-4, 4e-3),
        ("target", rms(fine, TexelFormat::Rgba8), rms(fine, TexelFormat::Rgba16f), 4e-4, 1e-2),
    ] {
        assert!(bytes > 1.5 * best && half < 0.7 * bytes, "{what}: {bytes}, {half}, {best}");
        assert!((low..high).contains(&bytes), "{what}: {bytes}");
    }
}

#[test]
fn passes_fill_the_sets_of_coordinates() {
    let hills = Hills::new(flat(3, 4));
    let mut card = BiScaleCard::new(device("gt200"), ExecutorKind::Batch, hills.mesh(), DisplayOptions::default())
        .expect("a card");
    let counts = card.counts();
    assert_eq!((counts.passes, counts.directions_per_pass), (2, 9));
    assert_eq!(card.volumes().collect::<Vec<_>>(), [[24, 24, 9]]);
    assert_eq!(counts.volume_bytes, 4 * 24 * 24 * 9);
    let view = MeshView { camera: camera(), exposure: 1.0, format: FLOATS };
    let (_, log) = card.logged_view(&hills.local, &view).expect("a frame");
    let draws: Vec<_> = log.iter().filter(|event| matches!(event, refsim::event::Event::Draw(_))).collect();
    assert_eq!(draws.len(), 3, "depth, nine directions, seven");
}

#[test]
fn what_does_not_fit_is_refused() {
    let hills = Hills::new(flat(3, 4));
    let refused = |profile: Profile, options: DisplayOptions| {
        BiScaleCard::new(profile, ExecutorKind::Batch, hills.mesh(), options)
            .map(|_| ())
            .expect_err("refused")
            .to_string()
    };
    let mut small = device("gt200");
    small.limits.max_volume_size = Some(23);
    let mut shallow = device("gt200");
    shallow.limits.max_volume_size = Some(8);
    let touching = DisplayOptions { edges: BlockEdges::Touching, ..DisplayOptions::default() };
    let signed = DisplayOptions { texture: TexelFormat::Rgba16Snorm, ..touching };
    let mut unfiltered = device("gt200");
    unfiltered.limits.float_filtering = false;
    let mut narrow = device("gt200");
    narrow.limits.texture_coordinates = Some(2);
    let messages = [
        refused(small, DisplayOptions::default()),
        refused(shallow, touching),
        refused(device("gt200"), signed),
        refused(unfiltered, floats(BlockEdges::Touching)),
        refused(narrow, touching),
        refused(device("r350"), touching),
    ];
    insta::assert_snapshot!(messages.join("\n"), @r"
    4 x 4 blocks of 6 x 6 texels in 9 layers need a volume of 24 x 24 x 9; `gt200` has volumes of 23 per side (limits.max_volume_size); use a smaller patch, or fewer directions
    4 x 4 blocks of 4 x 4 texels in 9 layers need a volume of 16 x 16 x 9; `gt200` has volumes of 8 per side (limits.max_volume_size); use a smaller patch, or fewer directions
    expected a bidirectional texture in rgba8, rgba16f or rgba32f, found rgba16s
    `gt200` does not filter rgba32f textures (limits.float_filtering); store samples in 8 bits
    a direction of light, texture coordinates and the view need 3 sets of texture coordinates; `gt200` has 2 (limits.texture_coordinates)
    device `r350` refuses the display: it runs no `ps_2_a` programs; expected one of nv30, nv35, gt200
    ");
}

#[test]
fn parts_that_do_not_go_together_are_refused() {
    let hills = Hills::new(flat(2, 2));
    let mut card = BiScaleCard::new(device("gt200"), ExecutorKind::Batch, hills.mesh(), DisplayOptions::default())
        .expect("a card");
    let view = |exposure| MeshView { camera: camera(), exposure, format: FLOATS };
    let mut refused = |local: &[[f32; 3]], exposure| {
        card.view_texels(local, &view(exposure)).map(|_| ()).expect_err("refused").to_string()
    };
    let bright = vec![[f32::MAX; 3]; hills.local.len()];
    let mut messages = vec![
        refused(&hills.local[1..], 1.0),
        refused(&hills.local, -1.0),
        refused(&bright, 1e3),
        refused(&hills.local, f64::NAN),
    ];
    let fewer = TexturedMesh { coordinates: &hills.coordinates[1..], ..hills.mesh() };
    let mut lost = hills.coordinates.clone();
    lost[3][1][0] = f32::NAN;
    let lost = TexturedMesh { coordinates: &lost, ..hills.mesh() };
    let untextured = TexturedMesh { texture_of: &hills.texture_of[1..], ..hills.mesh() };
    let other = TexturedMesh { texture_of: &[2; 50], ..hills.mesh() };
    let unlike = [flat(2, 2), flat(2, 3)];
    let unlike = TexturedMesh { textures: &unlike, ..hills.mesh() };
    for mesh in [fewer, lost, untextured, other, unlike] {
        let card = BiScaleCard::new(device("gt200"), ExecutorKind::Batch, mesh, DisplayOptions::default());
        messages.push(card.map(|_| ()).expect_err("refused").to_string());
    }
    messages.push(
        corner_coordinates(&crossbar_systems::transfer::synthetic::hills(2), [1.0; 2])
            .expect_err("refused")
            .to_string(),
    );
    insta::assert_snapshot!(messages.join("\n"), @r"
    expected 144 numbers of local light, found 143
    expected an exposure of 0 to 1e30, found -1
    expected local light times exposure that single precision holds, found 339025263248632160000000000000000000000000
    expected an exposure of 0 to 1e30, found NaN
    expected 50 triangles with texture coordinates, found 49
    expected finite texture coordinates, found NaN
    expected 50 triangles with a texture, found 49
    expected 3 textures, which triangles name, found 1
    expected 4 directions of light in each texture, found 9
    the mesh has no texture coordinates, which place a bidirectional texture
    ");
}
