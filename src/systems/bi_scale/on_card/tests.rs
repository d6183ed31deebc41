//! Products against the host bit by bit, blocks that nothing leaks from, pictures against f64, and what does not fit.

use glam::DVec3;
use refsim::device::Profile;
use refsim::machine::ExecutorKind;
use refsim::texture::{Image, Lod, SampleRules, TexelFormat, sample, touched};

use super::reference::{patch_at, pixel};
use super::*;
use crate::bi_scale::bicluster::{BiclusterOptions, Biclustering, bicluster};
use crate::bi_scale::directions::LocalDirections;
use crate::bi_scale::kernels::{BlockEdges, BlockGrid};
use crate::bi_scale::matrix::{MatrixEntry, SparseMatrix};
use crate::bi_scale::product::Gather;
use crate::bi_scale::texture::BidirectionalTexture;
use crate::card::{BILINEAR, MeshView, Texels, seen_pixels};
use crate::geom::random::CounterRng;
use crate::io::CoordinateMatrix;
use crate::scene::Camera;
use crate::transfer::synthetic::hills;
use crate::transfer::{Tangents, Vertices};

const FLOATS: TexelFormat = TexelFormat::Rgba32f;

fn device(name: &str) -> Profile {
    Profile::named(name).expect("a device")
}

/// Quarters in runs, so that there are biclusters of many rows; some rows and columns stay empty.
fn matrix(rows: usize, columns: usize, seed: u64) -> SparseMatrix {
    let random = CounterRng::new(seed);
    let mut matrix = SparseMatrix::new(columns, 2).expect("columns");
    for row in 0..rows {
        let value = |column: usize| match random.unit((row / 5) as u64, column as u64, 0) {
            draw if draw < 0.6 || row % 13 == 4 || column % 11 == 7 => 0,
            draw if draw < 0.9 => 4,
            _ => 1 + (4.0 * random.unit(row as u64, column as u64, 1)) as i32,
        };
        let entries = (0..columns).map(|column| MatrixEntry { index: column as u32, value: value(column) });
        let entries: Vec<MatrixEntry> = entries.filter(|entry| entry.value != 0).collect();
        matrix.push_row(&entries).expect("a row");
    }
    matrix
}

fn biclusters(matrix: &SparseMatrix) -> Biclustering {
    bicluster(matrix, BiclusterOptions::default(), &mut |_| ()).expect("biclusters")
}

fn light(columns: usize, seed: u64) -> Vec<[f32; 3]> {
    let random = CounterRng::new(seed);
    (0..columns as u64).map(|k| [0, 1, 2].map(|channel| (3.0 * random.unit(k, channel, 2)) as f32)).collect()
}

fn bits(numbers: &[[f32; 3]]) -> Vec<[u32; 3]> {
    numbers.iter().map(|rgb| rgb.map(f32::to_bits)).collect()
}

/// Values that single precision rounds are taken rounded, as the host's are; those beyond it are refused.
#[test]
fn values_beyond_single_precision_are_refused() {
    let of = |value: f64| {
        let matrix = CoordinateMatrix { rows: 1, columns: 2, entries: vec![(0, 1, value)] };
        biclusters(&SparseMatrix::from_coordinates(&matrix).expect("a matrix"))
    };
    let card = |found: &Biclustering| GatherCard::new(device("gt200"), ExecutorKind::Batch, found, LightFormat::Fp32);
    let tenth = of(0.1);
    let local = card(&tenth).expect("a card").multiply(&[[0.0; 3], [1.0, 2.0, 4.0]]).expect("a product");
    assert_eq!(local, [[0.1_f32, 0.2, 0.4]]);
    let error = card(&of(-1e300)).expect_err("refused").to_string();
    assert_eq!(
        error,
        "expected values of biclusters within single precision, found -1e300 in bicluster 0: scale the matrix"
    );
}

/// Small programs and textures make many passes and sheets of the same sums.
#[test]
fn products_are_the_hosts_bit_by_bit() {
    for (rows, columns, seed) in [(300, 90, 1), (77, 200, 2), (1, 1, 3), (5, 40, 4)] {
        let matrix = matrix(rows, columns, seed);
        let found = biclusters(&matrix);
        for (name, instructions, side) in [("gt200", 512, 8192), ("ideal-fp32", 512, 8192), ("gt200", 40, 32)] {
            let mut profile = device(name);
            profile.limits.instructions = Some(instructions);
            profile.limits.max_texture_size = Some(side);
            let mut card = GatherCard::new(profile, ExecutorKind::Batch, &found, LightFormat::Fp32).expect("a card");
            let counts = card.counts();
            let least = [found.column_entries(), found.row_entries()].map(|count| count as u64);
            assert!(counts.places[0] >= least[0] && counts.places[1] >= least[1], "{counts:?}, {least:?}");
            assert!(instructions == 512 || rows < 50 || counts.passes[1] > 5, "{counts:?}");
            for seed in 10..12 {
                let light = light(columns, seed);
                let local = card.multiply(&light).expect("a product");
                assert_eq!(bits(&local), bits(&Gather::new(&found).multiply(&light)), "{rows} x {columns}, {name}");
            }
            let negative: Vec<[f32; 3]> = light(columns, 5).iter().map(|rgb| rgb.map(|value| 1.5 - value)).collect();
            let local = card.multiply(&negative).expect("a product");
            assert_eq!(bits(&local), bits(&Gather::new(&found).multiply(&negative)), "{rows} x {columns}, {name}");
        }
    }
}

/// Light in fewer bits is off by half a step of the largest number at most, for each unit of a row.
#[test]
fn light_in_fewer_bits_is_off_by_its_steps() {
    let (matrix, light) = (matrix(200, 100, 6), light(100, 7));
    let found = biclusters(&matrix);
    let expected = Gather::new(&found).multiply(&light);
    let mut worst = Vec::new();
    for (format, step) in [(LightFormat::Bytes, 1.0 / 255.0), (LightFormat::Fp16, 1.0 / 2048.0)] {
        let mut card = GatherCard::new(device("gt200"), ExecutorKind::Batch, &found, format).expect("a card");
        let local = card.multiply(&light).expect("a product");
        let largest = light.as_flattened().iter().fold(0.0_f32, |most, &value| most.max(value));
        let mut off = 0.0_f64;
        for (row, (local, expected)) in local.iter().zip(&expected).enumerate() {
            let unit: f64 = matrix.row(row).iter().map(|entry| matrix.value(entry.value)).sum();
            let bound = unit * f64::from(largest) * (0.5 * step + 1e-6);
            for channel in 0..3 {
                let error = (f64::from(local[channel]) - f64::from(expected[channel])).abs();
                assert!(error <= bound, "{format}, row {row}: {error} of {bound}");
                off = off.max(error);
            }
        }
        worst.push(off);
    }
    assert!(worst[0] > 4.0 * worst[1] && worst[1] > 0.0, "{worst:?}");
}

/// Texture coordinates of a place in a block, by the arithmetic of the program.
fn coordinates(grid: &BlockGrid, (light, view): (usize, usize), uv: [f32; 2]) -> [u32; 4] {
    let [width, height, layers] = grid.extents().map(|side| side as f64);
    let (size, border) = (grid.size as f64, grid.border() as f64);
    let origin = grid.origin(light);
    let axis = |at: f32, origin: usize, side: f64| {
        let mut at = at - at.floor();
        if grid.edges == BlockEdges::Touching {
            at = at.max((0.5 / size) as f32).min((1.0 - 0.5 / size) as f32);
        }
        at * (size / side) as f32 + (border / side) as f32 + (origin as f64 / side) as f32
    };
    let layer = view as f32 * (1.0 / layers) as f32 + (0.5 / layers) as f32;
    [axis(uv[0], origin[0], width), axis(uv[1], origin[1], height), layer, 0.0].map(f32::to_bits)
}

/// Numbers around those at which a read would leave its block.
fn edges_of(size: usize) -> Vec<f32> {
    let step = 1.0 / size as f32;
    let ends = [0.0, 0.25 * step, 0.5 * step, step, 0.5, 1.0 - step, 1.0 - 0.5 * step, 1.0, -1e-9, -0.25, 7.5, 40.0];
    ends.into_iter().flat_map(|at: f32| [at.next_down(), at, at.next_up()]).collect()
}

fn directions(side: usize) -> LocalDirections {
    LocalDirections::new(side).expect("directions")
}

fn texture(size: usize, views: usize, lights: usize, value: impl Fn(usize) -> [f32; 3]) -> BidirectionalTexture {
    let count = size * size * views * views * lights * lights;
    let samples = (0..count).map(value).collect();
    BidirectionalTexture::new(size, directions(views), directions(lights), samples).expect("a texture")
}

/// Every texel that has a part in a read, named exactly, is one of its own block and layer.
#[test]
fn no_read_reaches_another_block_or_layer() {
    let rules = SampleRules::from(&device("gt200").rules);
    let random = CounterRng::new(8);
    for (size, views, lights) in [(4, 3, 3), (16, 2, 5), (5, 12, 2), (64, 2, 8), (1, 2, 2)] {
        for edges in [BlockEdges::Touching, BlockEdges::Wrapped] {
            let texture = texture(size, views, lights, |at| [(at % 250) as f32; 3]);
            let (image, grid, _) = volume_image(&device("gt200"), &texture, edges, TexelFormat::Rgba8).expect("fits");
            let ends = edges_of(size);
            for number in 0..4000_u64 {
                let pick = |dimension| random.unit(number, size as u64, dimension);
                let at = |dimension| match pick(dimension) {
                    draw if draw < 0.5 => ends[(2.0 * draw * ends.len() as f64) as usize],
                    draw => (40.0 * draw - 30.0) as f32,
                };
                let (light, view) =
                    ((pick(0) * (lights * lights) as f64) as usize, (pick(1) * (views * views) as f64) as usize);
                let at = coordinates(&grid, (light, view), [at(2), at(3)]);
                let mut count = 0;
                touched(&image, &BILINEAR, &rules, at, Lod::Base, |_, slice, row, column| {
                    assert_eq!(
                        (slice as usize, grid.shown(column as usize, row as usize).0),
                        (view, light),
                        "{grid:?}"
                    );
                    count += 1;
                });
                assert!((1..=4).contains(&count), "{count} texels");
            }
        }
    }
}

fn value(image: &Image, rules: &SampleRules, at: [u32; 4]) -> [f64; 3] {
    let [red, green, blue, _] = sample(Some(image), &BILINEAR, rules, at, Lod::Base);
    [red, green, blue].map(|bits| f64::from(f32::from_bits(bits)))
}

/// With weights that the sampler can represent and samples of few bits nothing is rounded.
#[test]
fn blocks_repeat_as_the_hosts_patch_does() {
    let (random, rules) = (CounterRng::new(9), SampleRules::from(&device("gt200").rules));
    let of = |at: usize| [0, 1, 2].map(|channel| (256.0 * random.unit(at as u64, channel, 0)).floor() as f32);
    for (size, views, lights) in [(8, 2, 3), (16, 3, 2)] {
        let texture = texture(size, views, lights, of);
        for edges in [BlockEdges::Touching, BlockEdges::Wrapped] {
            let (image, grid, scale) = volume_image(&device("gt200"), &texture, edges, FLOATS).expect("fits");
            assert_eq!(scale, 1.0);
            for number in 0..3000_u64 {
                let pick = |dimension, most: usize| (random.unit(number, 1, dimension) * most as f64) as usize;
                let (light, view) = (pick(0, lights * lights), pick(1, views * views));
                let uv = [2, 3].map(|dimension| pick(dimension, 768 * size) as f32 / (256 * size) as f32 - 1.0);
                let found = value(&image, &rules, coordinates(&grid, (light, view), uv));
                let expected = patch_at(texture.patch(view, light), size, uv.map(f64::from), edges);
                assert_eq!(found, expected, "{grid:?}, light {light}, view {view}, {uv:?}");
            }
        }
    }
}

/// Hills with a texture of a formula, and made-up local light.
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

    /// Root mean square and largest difference from equation 3 in f64, as shares of the largest pixel.
    fn error(&self, profile: &Profile, edges: BlockEdges, drawing: &Texels) -> [f64; 2] {
        let seen = seen_pixels(profile, self.vertices.geometry(), &camera()).expect("pixels");
        let local: Vec<[f64; 3]> = self.local.iter().map(|rgb| rgb.map(f64::from)).collect();
        let (mut worst, mut largest, mut squares, mut count) = (0.0_f64, 0.0_f64, 0.0, 0);
        for (texel, seen) in drawing.texels.iter().zip(&seen) {
            assert_eq!(texel[3] != 0.0, seen.is_some(), "what is covered");
            let Some(seen) = seen else { continue };
            let expected = pixel(&self.mesh(), &local, camera().eye(), edges, seen);
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

/// From the side, so that hills hide each other and views come near the horizon, and below it.
fn camera() -> Camera {
    Camera::new([0.6, -2.2, 1.6], [0.0; 3], [0.0, 0.0, 1.0], 0.5, 44, 36).expect("a camera")
}

/// A texture with one color throughout a patch, so that only view, light and their sums matter.
fn flat(views: usize, lights: usize) -> BidirectionalTexture {
    let random = CounterRng::new(22);
    texture(4, views, lights, |at| [0, 1, 2].map(|channel| random.unit((at / 16) as u64, channel, 0) as f32))
}

fn rough(size: usize, views: usize, lights: usize) -> BidirectionalTexture {
    let random = CounterRng::new(23);
    texture(size, views, lights, |at| [0, 1, 2].map(|channel| random.unit(at as u64, channel, 0) as f32))
}

fn floats(edges: BlockEdges) -> DisplayOptions {
    DisplayOptions { edges, texture: FLOATS, local: LocalFormat::Fp32 }
}

#[test]
fn pictures_are_equation_3_of_what_is_interpolated() {
    for (name, views, lights) in
        [("ideal-fp32", 5, 3), ("gt200", 12, 3), ("gt200", 1, 1), ("gt200", 4, 2), ("ideal-fp32", 3, 5)]
    {
        let hills = Hills::new(flat(views, lights));
        let options = floats(BlockEdges::default());
        let [_, error] = hills.error(&device(name), options.edges, &hills.draw(&device(name), options, FLOATS));
        assert!(error < 3e-6, "{name}, {views}, {lights}: {error}");
    }
    // With texels that differ the sampler's weights show, whose bits are given.
    for bits in [8, 12] {
        let mut profile = device("ideal-fp32");
        profile.rules.filter_fraction_bits = bits;
        for edges in [BlockEdges::Touching, BlockEdges::Wrapped] {
            let hills = Hills::new(rough(8, 4, 3));
            let [_, error] = hills.error(&profile, edges, &hills.draw(&profile, floats(edges), FLOATS));
            let bound = 3e-6 + 1.0 / f64::from(1_u32 << bits);
            assert!(error < bound, "{bits} bits, {edges}: {error} of {bound}");
        }
    }
}

/// Triangles show their own textures, of any sizes and views; what is drawn twice are directions alone, and no pixel
/// belongs to two textures. A texture that no triangle names takes nothing.
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
    let [_, error] = hills.error(&profile, options.edges, &drawing);
    assert!(error < 3e-6, "{error}");
    let counts =
        BiScaleCard::new(profile.clone(), ExecutorKind::Batch, hills.mesh(), options).expect("a card").counts();
    assert_eq!((counts.passes, counts.draws), (2, 4));
    hills.texture_of = vec![0; 50];
    let one = hills.draw(&profile, options, FLOATS);
    let differ = one.texels.iter().zip(&drawing.texels).filter(|(a, b)| a != b).count();
    assert!((100..1400).contains(&differ), "{differ}");
}

/// Each thing held in fewer bits, the others in single precision.
#[test]
fn fewer_bits_show() {
    let hills = Hills::new(rough(8, 4, 4));
    let fine = floats(BlockEdges::Wrapped);
    // The sampler's weights in more bits than the card's, so that they hide nothing.
    let mut profile = device("gt200");
    profile.rules.filter_fraction_bits = 12;
    let rms = |options, format| hills.error(&profile, fine.edges, &hills.draw(&profile, options, format))[0];
    let best = rms(fine, FLOATS);
    let texture = |texture| rms(DisplayOptions { texture, ..fine }, FLOATS);
    let local = |local| rms(DisplayOptions { local, ..fine }, FLOATS);
    for (what, bytes, half, low, high) in [
        ("texture", texture(TexelFormat::Rgba8), texture(TexelFormat::Rgba16f), 1e-4, 4e-3),
        ("local light", local(LocalFormat::Bytes), local(LocalFormat::Fp16), 1e-4, 4e-3),
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
    4 x 4 blocks of 6 x 6 texels in 9 layers need a volume of 24 x 24 x 9; `gt200` has volumes of 23 a side (limits.max_volume_size); take a smaller patch, or fewer directions
    4 x 4 blocks of 4 x 4 texels in 9 layers need a volume of 16 x 16 x 9; `gt200` has volumes of 8 a side (limits.max_volume_size); take a smaller patch, or fewer directions
    expected a bidirectional texture in rgba8, rgba16f or rgba32f, found rgba16s
    `gt200` filters no rgba32f textures (limits.float_filtering); hold samples in 8 bits
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
    messages
        .push(corner_coordinates(&crate::transfer::synthetic::hills(2), [1.0; 2]).expect_err("refused").to_string());
    let found = biclusters(&matrix(20, 10, 1));
    let mut card = GatherCard::new(device("gt200"), ExecutorKind::Batch, &found, LightFormat::Bytes).expect("a card");
    for light in [vec![[1.0; 3]; 9], vec![[-1.0; 3]; 10], vec![[f32::INFINITY; 3]; 10]] {
        messages.push(card.multiply(&light).expect_err("refused").to_string());
    }
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
    the mesh has no texture coordinates, by which a bidirectional texture is placed
    expected 10 numbers of light, found 9
    expected light of finite numbers, of 0 or more in bytes, found -1
    expected light of finite numbers, of 0 or more in bytes, found inf
    ");
}
