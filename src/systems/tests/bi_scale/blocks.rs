//! Blocks of a volume do not leak into each other.

use crossbar_systems::bi_scale::kernels::{BlockEdges, BlockGrid};
use crossbar_systems::bi_scale::on_card::volume_image;
use crossbar_systems::bi_scale::texture::GridSamples;
use refsim::texture::{Image, Lod, SampleRules, TexelFormat, sample, touched};

use super::{FLOATS, texture};
use crate::card::BILINEAR;
use crate::device;
use crate::geom::random::CounterRng;

/// Texture coordinates of a position in a block, computed as in the program.
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

/// Numbers around the limits at which a read would leave its block.
fn edges_of(size: usize) -> Vec<f32> {
    let step = 1.0 / size as f32;
    let ends = [0.0, 0.25 * step, 0.5 * step, step, 0.5, 1.0 - step, 1.0 - 0.5 * step, 1.0, -1e-9, -0.25, 7.5, 40.0];
    ends.into_iter().flat_map(|at: f32| [at.next_down(), at, at.next_up()]).collect()
}

/// Every texel that contributes to a read, computed exactly, belongs to the read's block and layer.
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

/// Results are exact here: the sampler can represent all weights, and samples have few bits.
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
                let inside = |at: f64| (at - at.floor()).clamp(0.5 / size as f64, 1.0 - 0.5 / size as f64);
                let place = uv.map(|at| if edges == BlockEdges::Touching { inside(at.into()) } else { at.into() });
                let GridSamples { numbers, weights } = GridSamples::of_texels(size, place);
                let patch = texture.patch(view, light);
                let terms = |channel: usize| numbers.map(|number| f64::from(patch[number][channel])).into_iter();
                let expected = [0, 1, 2].map(|channel| terms(channel).zip(weights).map(|(b, w)| w * b).sum::<f64>());
                assert_eq!(found, expected, "{grid:?}, light {light}, view {view}, {uv:?}");
            }
        }
    }
}
