//! The card's results per vertex, compared bit for bit with the host's sums; limits of devices.

use std::sync::{Arc, Mutex};

use crossbar_systems::clustering::{Clustering, CpcaForm, CpcaMethod, CpcaOptions, compress};
use crossbar_systems::cpca::on_card::{
    CardWeights, CompressedTransfer, Products, PrtCard, PrtCardOptions, WeightFormat,
};
use crossbar_systems::transfer::brdf::ExitBasis;
use crossbar_systems::transfer::synthetic::{hills, signal_at};
use crossbar_systems::transfer::{Tangents, Vertices};
use refsim::device::{MadMode, Rules};
use refsim::exec::scalar::VertexProgram;
use refsim::exec::{CheckedProgram, Constants, NoObserver};
use refsim::machine::{DrawCall, DrawWatcher, Executor, ExecutorKind, Machine, MachineError, VertexSource};
use refsim::num::{Format, ops};
use refsim::texture::TexelFormat;

use crate::card::{CardError, MeshView};
use crate::device;
use crate::scene::Camera;
use crate::sphere::{HarmonicLight, ParabolicMap};

/// The vertices of a draw, register by register, with their program and constants.
#[derive(Debug)]
struct SeenDraw {
    attributes: Vec<Vec<[u32; 4]>>,
    program: CheckedProgram,
    constants: Constants,
    triangles: usize,
}

#[derive(Debug, Default)]
struct SeenDraws(Mutex<Vec<SeenDraw>>);

impl DrawWatcher for SeenDraws {
    fn before(&self, _: &Machine, call: &DrawCall<'_>) -> Result<(), MachineError> {
        if let VertexSource::Program { program, constants, streams } = &call.vertices {
            self.0.lock().expect("a list").push(SeenDraw {
                attributes: streams.streams.iter().map(|stream| stream.data.to_vec()).collect(),
                program: (*program).clone(),
                constants: (*constants).clone(),
                triangles: call.indices.map_or(0, |indices| indices.len() / 3),
            });
        }
        Ok(())
    }
}

const EXPOSURE: f64 = 0.7;

/// The superclusters of a card, and the draws of a frame: the mesh into the depth buffer, then chunk by chunk.
fn draws(
    name: &str,
    transfer: CompressedTransfer<'_>,
    options: &PrtCardOptions,
    light: &HarmonicLight,
) -> (crossbar_systems::cpca::coherence::Superclusters, Vec<SeenDraw>) {
    let watcher = Arc::new(SeenDraws::default());
    let executor = Executor::from(ExecutorKind::Batch).watched(watcher.clone());
    let mut card = PrtCard::new(device(name), executor, transfer, options).unwrap_or_else(|e| panic!("{name}: {e}"));
    let camera = Camera::new([0.6, -2.2, 1.6], [0.0; 3], [0.0, 0.0, 1.0], 0.5, 8, 6).expect("a camera");
    let view = MeshView { camera, exposure: EXPOSURE, format: TexelFormat::Bgra8 };
    card.view_texels(light, &view).unwrap_or_else(|e| panic!("{name}: {e}"));
    let seen = std::mem::take(&mut *watcher.0.lock().expect("a list"));
    (card.superclusters().clone(), seen)
}

/// The power of two that divides functions in fixed-point maps, and multiplies products.
fn map_scale(basis: &ExitBasis, side: usize) -> f64 {
    let (map, mut most, mut y) = (ParabolicMap::new(side), 0.0_f64, vec![0.0; basis.len()]);
    for texel in 0..side * side {
        basis.values(map.direction(texel % side, texel / side), &mut y);
        most = y.iter().fold(most, |most, value| most.max(value.abs()));
    }
    (0..9).map(|power| f64::from(1 << power)).find(|scale| most <= *scale).expect("a scale")
}

/// Every vertex of every chunk has the host's sums if it is inside the supercluster, else zeros.
#[test]
fn vertex_programs_give_the_hosts_sums() {
    for (basis, clusters, vectors) in
        [(ExitBasis::Radiance, 7, 5), (ExitBasis::Radiance, 3, 0), (glossy(16), 9, 6), (glossy(24), 6, 8)]
    {
        let hills = CompressedHills::new(basis, clusters, vectors, CpcaMethod::Iterative);
        let transfer = hills.transfer(vectors);
        let light = HarmonicLight::red_and_blue(4);
        for (name, superclusters, weights) in [
            ("r300", true, WeightFormat::Fp32),
            ("r300", false, WeightFormat::Unorm8),
            ("r350", true, WeightFormat::Fp16),
            ("nv35", true, WeightFormat::Unorm16),
        ] {
            let map_format = if name == "nv35" { TexelFormat::Rgba8Snorm } else { TexelFormat::Rgba16Snorm };
            let options = PrtCardOptions { superclusters, map_format, weights, ..PrtCardOptions::default() };
            let (_, draws) = draws(name, transfer, &options, &light);
            let scale = if transfer.is_glossy() { map_scale(transfer.basis, options.map_side) } else { 1.0 };
            let weights = CardWeights::new(&hills.clustering, weights);
            let products = Products::new(&transfer, &weights, &light, EXPOSURE * scale).expect("products");
            let rules = device(name).rules;
            let expected = exit_coefficients(&rules, &transfer, &weights, &products);
            let (whole, chunks) = draws.split_first().expect("draws");
            let masks = if transfer.is_glossy() { 3 } else { 1 };
            let inside: usize = chunks
                .iter()
                .enumerate()
                .map(|(at, chunk)| check_chunk(&rules, chunk, at % masks, &transfer, &whole.attributes[0], &expected))
                .sum();
            assert_eq!(inside, masks * hills.vertices.len(), "{name}: each vertex once");
        }
    }
}

/// Checks one pass over a chunk; returns the number of vertices inside the supercluster. `positions` has all vertices.
fn check_chunk(
    rules: &Rules,
    chunk: &SeenDraw,
    channel: usize,
    transfer: &CompressedTransfer<'_>,
    positions: &[[u32; 4]],
    expected: &[[Vec<f32>; 3]],
) -> usize {
    let program = VertexProgram::new(&chunk.program, rules, &chunk.constants);
    let mut count = 0;
    for at in 0..chunk.attributes[0].len() {
        let mut attributes = [[0; 4]; 16];
        attributes.iter_mut().zip(&chunk.attributes).for_each(|(into, from)| *into = from[at]);
        let (result, _) = program.run(&attributes, &mut NoObserver);
        let alpha = f32::from_bits(attributes[1][1]);
        let vertex = positions.iter().position(|position| *position == attributes[0]).expect("a vertex");
        let sums = &expected[vertex];
        let wanted: Vec<f32> = match transfer.is_glossy() {
            true => sums[channel].clone(),
            false => sums.iter().map(|rows| rows[0]).collect(),
        };
        for (place, wanted) in wanted.iter().enumerate() {
            let found = f32::from_bits(result.vertex.texcoords[place / 4][place % 4]);
            if alpha == 0.0 {
                assert_eq!(found, 0.0, "outside");
            } else {
                assert_eq!(found.to_bits(), wanted.to_bits(), "vertex {vertex}, number {place}: {found} {wanted}");
            }
        }
        count += usize::from(alpha == 1.0);
    }
    count
}

#[test]
fn chunks_are_the_overdraw() {
    let hills = CompressedHills::new(glossy(24), 12, 8, CpcaMethod::Iterative);
    for superclusters in [false, true] {
        let options = PrtCardOptions { superclusters, ..PrtCardOptions::default() };
        let (found, draws) = draws("r300", hills.transfer(8), &options, &HarmonicLight::red_and_blue(4));
        let drawn: usize = draws[1..].iter().map(|chunk| chunk.triangles).sum();
        assert_eq!(drawn as u64, 3 * found.overdraw(&hills.clustering, hills.vertices.triangles()));
        assert_eq!(found.count() < 12, superclusters);
    }
}

/// Compressed transfer of hills: diffuse for light of 16 coefficients, or glossy with a number of functions for light
/// of 4 coefficients.
struct CompressedHills {
    vertices: Vertices,
    clustering: Clustering,
    basis: ExitBasis,
}

impl CompressedHills {
    fn new(basis: ExitBasis, clusters: usize, vectors: usize, method: CpcaMethod) -> Self {
        let vertices = Vertices::new(&hills(9), Tangents::Any).expect("vertices");
        let columns = if matches!(basis, ExitBasis::Radiance) { 16 } else { 4 };
        let place = |at: usize| vertices.positions()[at].map(f64::from);
        let signal = signal_at(vertices.len(), basis.len() * columns, 5, place);
        let options =
            CpcaOptions { clusters, vectors, vq_iterations: 4, iterations: 4, method, form: CpcaForm::Affine, seed: 1 };
        let clustering = compress(&signal, &options, |_| ()).expect("compressed").clustering;
        Self { vertices, clustering, basis }
    }

    fn transfer(&self, vectors: usize) -> CompressedTransfer<'_> {
        let Self { vertices, clustering, basis } = self;
        CompressedTransfer { vertices, clustering, basis, channels: 1, vectors }
    }
}

fn glossy(functions: usize) -> ExitBasis {
    match functions {
        24 => ExitBasis::without_1_0(5).expect("order 5"),
        _ => ExitBasis::of_order(functions.isqrt()),
    }
}

fn card<'a>(name: &str, transfer: CompressedTransfer<'a>, options: &PrtCardOptions) -> Result<PrtCard<'a>, CardError> {
    PrtCard::new(device(name), ExecutorKind::Batch, transfer, options)
}

/// The exit radiance of every vertex in the card's arithmetic: three channels per vertex, with one number per row of
/// the transfer. Alpha times the mean's product is first; then weight times product is added vector by vector. Product
/// and sum are rounded separately, or once on devices with a fused multiply-add.
fn exit_coefficients(
    rules: &Rules,
    transfer: &CompressedTransfer<'_>,
    card_weights: &CardWeights,
    products: &Products,
) -> Vec<[Vec<f32>; 3]> {
    let of_point = transfer.clustering.of_point().iter().enumerate();
    let of_vertex = |(vertex, &cluster): (usize, &u32)| {
        let weights = transfer.clustering.weights(vertex).iter().enumerate();
        let weights: Vec<f32> =
            weights.map(|(at, &weight)| card_weights.attribute(cluster as usize, at, weight)).collect();
        let vectors: Vec<[&[f32]; 3]> = products.vectors(cluster as usize).collect();
        [0, 1, 2].map(|channel| {
            let row = |row| sum(rules, transfer.vectors, &weights, vectors.iter().map(|vector| vector[channel][row]));
            (0..transfer.basis.len()).map(row).collect()
        })
    };
    of_point.map(of_vertex).collect()
}

/// 1 times the first number, plus weight times number for `vectors` weights; missing weights are 0.
fn sum(rules: &Rules, vectors: usize, weights: &[f32], mut numbers: impl Iterator<Item = f32>) -> f32 {
    let format = rules.vertex_format;
    let enter = |value: f32| ops::convert(&Format::FP32, format, value.to_bits()).bits;
    let mut next = || enter(numbers.next().unwrap_or(0.0));
    let mut sum = ops::mul(format, enter(1.0), next()).bits;
    for vector in 0..vectors {
        let (weight, number) = (enter(weights.get(vector).copied().unwrap_or(0.0)), next());
        sum = match rules.mad {
            MadMode::TwoRoundings => ops::add(format, ops::mul(format, weight, number).bits, sum).bits,
            MadMode::Fused => ops::fused_mad(format, weight, number, sum).bits,
            MadMode::ProductCut => ops::product_cut_mad(format, weight, number, sum).bits,
        };
    }
    f32::from_bits(ops::convert(&format, Format::FP32, sum).bits)
}

/// Each weight is within its format's step, relative to its cluster's range; zero and the ends of the range are exact.
#[test]
fn weights_are_as_near_as_their_format() {
    let hills = CompressedHills::new(glossy(16), 5, 6, CpcaMethod::Iterative);
    let clustering = &hills.clustering;
    for (format, relative, of_range) in [
        (WeightFormat::Fp32, f64::from(f32::EPSILON) / 2.0, 0.0),
        (WeightFormat::Fp16, 1.0 / 2048.0, 0.0),
        (WeightFormat::Unorm16, 1e-7, 0.5 / 65535.0),
        (WeightFormat::Unorm8, 1e-7, 0.5 / 255.0),
    ] {
        let weights = CardWeights::new(clustering, format);
        let (mut largest, mut allowed_largest) = (0.0_f64, 0.0_f64);
        for (point, &cluster) in clustering.of_point().iter().enumerate() {
            let ranges = weights.ranges(cluster as usize);
            for (vector, (&weight, [low, extent])) in clustering.weights(point).iter().zip(ranges).enumerate() {
                let read = low + extent * f64::from(weights.attribute(cluster as usize, vector, weight));
                let allowed = relative * weight.abs().max(low.abs() + extent) + of_range * extent + 6e-8;
                assert!((read - weight).abs() <= allowed, "{format}: {weight} {read}");
                largest = largest.max((read - weight).abs());
                allowed_largest = allowed_largest.max(allowed);
            }
        }
        assert!(largest > allowed_largest / 20.0, "{format}: {largest} of {allowed_largest} allowed");
    }
}

#[test]
fn what_does_not_fit_is_refused() {
    let message = |name: &str, hills: &CompressedHills, vectors, options: &PrtCardOptions| {
        card(name, hills.transfer(vectors), options).map(|_| ()).expect_err("refused").to_string()
    };
    let options = PrtCardOptions::default();
    let twenty = CompressedHills::new(glossy(24), 1, 20, CpcaMethod::Iterative);
    assert!(card("r300", twenty.transfer(20), &options).is_ok());
    let refused = message("nv25", &twenty, 20, &options);
    assert!(
        refused.contains("`nv25` refuses glossy transfer: it runs no `ps_2_0`") && refused.contains("r300"),
        "{refused}"
    );
    let forty = CompressedHills::new(glossy(24), 1, 40, CpcaMethod::Iterative);
    let refused = message("r300", &forty, 40, &options);
    assert!(refused.contains("256") && refused.contains("258"), "constants suffice, slots do not: {refused}");
    let wide = CompressedHills::new(glossy(36), 2, 2, CpcaMethod::Iterative);
    let refused = message("r300", &wide, 2, &options);
    assert!(refused.contains("at most 28 functions") && refused.ends_with("found 36"), "{refused}");
    let adaptive = CompressedHills::new(ExitBasis::Radiance, 6, 3, CpcaMethod::Adaptive { rounds: 3 });
    let refused = message("r300", &adaptive, 3, &options);
    assert!(refused.contains("expected at most 3") && refused.contains("on the host alone"), "{refused}");
    let diffuse = CompressedHills::new(ExitBasis::Radiance, 2, 2, CpcaMethod::Iterative);
    let refused = message("r300", &diffuse, 57, &options);
    assert!(refused.contains("at most 56 vectors"), "{refused}");
    let three = CompressedTransfer { channels: 3, ..diffuse.transfer(2) };
    let refused = |result: Result<Products, CardError>| result.expect_err("refused").to_string();
    let shape = card("r300", three, &options).map(|_| ()).expect_err("refused").to_string();
    let dim = HarmonicLight::constant(3, [1.0; 3]).expect("a light");
    let weights = CardWeights::new(&diffuse.clustering, WeightFormat::Fp32);
    let order = refused(Products::new(&diffuse.transfer(2), &weights, &dim, 1.0));
    let bright = HarmonicLight::constant(4, [1e30; 3]).expect("a light");
    let finite = refused(Products::new(&diffuse.transfer(2), &weights, &bright, 1e30));
    assert!(shape.starts_with("expected 3 x 1 x n^2 numbers per vertex") && shape.contains("found 16"), "{shape}");
    assert_eq!(order, "expected light of order 4 or more, found 3");
    assert!(finite.starts_with("expected products of finite size, found"), "{finite}");
}
