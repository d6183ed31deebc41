//! Runs bi-scale transfer on every executor: light times biclusters, and pictures of bidirectional textures.

use crossbar::bi_scale::bicluster::{BiclusterOptions, bicluster};
use crossbar::bi_scale::directions::LocalDirections;
use crossbar::bi_scale::kernels::BlockEdges;
use crossbar::bi_scale::matrix::{MatrixEntry, SparseMatrix};
use crossbar::bi_scale::on_card::{BiScaleCard, DisplayOptions, GatherCard, LightFormat, LocalFormat, TexturedMesh};
use crossbar::bi_scale::product::Gather;
use crossbar::bi_scale::texture::BidirectionalTexture;
use crossbar::geom::random::CounterRng;
use crossbar::transfer::synthetic::hills;
use crossbar::transfer::{Tangents, Vertices};
use refsim::texture::TexelFormat;

use crate::rules::profile;
use crate::system::{all_find, pictures_agree};

#[test]
fn products_are_the_same_everywhere_and_the_hosts() {
    let random = CounterRng::new(4);
    let columns = 60;
    let mut matrix = SparseMatrix::new(columns, 2).expect("columns");
    for row in 0..150_u64 {
        let value = |column: u64| if random.unit(row / 4, column, 0) < 0.3 { 4 - (row * column % 3) as i32 } else { 0 };
        let entries = (0..columns as u32).map(|index| MatrixEntry { index, value: value(index.into()) });
        let entries: Vec<MatrixEntry> = entries.filter(|entry| entry.value != 0).collect();
        matrix.push_row(&entries).expect("a row");
    }
    let found = bicluster(&matrix, BiclusterOptions::default(), &mut |_| ()).expect("biclusters");
    let light: Vec<[f32; 3]> =
        (0..columns as u64).map(|k| [0, 1, 2].map(|channel| random.unit(k, channel, 1) as f32)).collect();
    let host: Vec<[u32; 3]> = Gather::new(&found).multiply(&light).iter().map(|rgb| rgb.map(f32::to_bits)).collect();
    for (device, format) in [
        ("gt200", LightFormat::Fp32),
        ("gt200", LightFormat::Bytes),
        ("ideal-fp32", LightFormat::Fp32),
        ("ideal-fp16", LightFormat::Fp16),
    ] {
        all_find(&format!("{device}, {format}"), |what, executor| {
            let mut profile = profile(device);
            // So few instructions that sums take several passes.
            profile.limits.instructions = Some(60);
            let mut card = GatherCard::new(profile, executor, &found, format).unwrap_or_else(|e| panic!("{what}: {e}"));
            let local = card.multiply(&light).unwrap_or_else(|e| panic!("{what}: {e}"));
            let bits: Vec<[u32; 3]> = local.iter().map(|rgb| rgb.map(f32::to_bits)).collect();
            assert!(format != LightFormat::Fp32 || bits == host, "{what}: differs from the host");
            bits
        });
    }
}

#[test]
fn pictures_are_the_same_everywhere() {
    let vertices = Vertices::new(&hills(4), Tangents::Any).expect("vertices");
    let random = CounterRng::new(5);
    let at = |vertex: u32| {
        let [x, y, _] = vertices.positions()[vertex as usize];
        [1.7 * x, 0.9 * y + 0.3]
    };
    let coordinates: Vec<[[f32; 2]; 3]> = vertices.triangles().iter().map(|corners| corners.map(at)).collect();
    let of = |side| LocalDirections::new(side).expect("directions");
    let halves =
        DisplayOptions { edges: BlockEdges::Touching, texture: TexelFormat::Rgba16f, local: LocalFormat::Fp16 };
    let wrapped =
        DisplayOptions { edges: BlockEdges::Wrapped, texture: TexelFormat::Rgba32f, local: LocalFormat::Bytes };
    for (device, format, size, views, lights, options) in [
        ("gt200", TexelFormat::Bgra8, 8, 3, 4, DisplayOptions::default()),
        ("gt200", TexelFormat::Rgba16f, 5, 2, 3, halves),
        ("ideal-fp32", TexelFormat::Rgba32f, 4, 12, 2, wrapped),
        ("ideal-fp16", TexelFormat::Rgba32f, 4, 2, 2, DisplayOptions::default()),
    ] {
        let count = (size * size * views * views * lights * lights) as u64;
        let samples = (0..count).map(|at| [0, 1, 2].map(|channel| random.unit(at, channel, 0) as f32)).collect();
        let texture = BidirectionalTexture::new(size, of(views), of(lights), samples).expect("a texture");
        let flat = BidirectionalTexture::new(1, of(1), of(lights), vec![[0.3, 0.2, 0.1]; lights * lights]);
        let textures = [texture, flat.expect("a texture")];
        let texture_of: Vec<u32> = (0..coordinates.len() as u32).map(|triangle| triangle % 3 / 2).collect();
        let numbers = (vertices.len() * lights * lights) as u64;
        let local: Vec<[f32; 3]> =
            (0..numbers).map(|at| [0, 1, 2].map(|channel| (0.2 * random.unit(at, channel, 1)) as f32)).collect();
        let mesh = TexturedMesh {
            vertices: &vertices,
            coordinates: &coordinates,
            textures: &textures,
            texture_of: &texture_of,
        };
        pictures_agree(
            &format!("{device}, {format}, {options:?}"),
            format,
            |executor| BiScaleCard::new(profile(device), executor, mesh, options),
            |card, view| card.view_texels(&local, view),
        );
    }
}
