//! Host speed of shading with all-frequency transfer: data in the sizes of the paper's teapot (51,300 vertices, ten
//! terms, sixteen representatives, 3,801 clusters, omega of 61.8 %), all light coefficients, two threads.
//!
//! Figure to beat: 13 frames per second without drawing (77 ms for steps 2 and 3), ten times the printed 1.3. An
//! element is one multiplication of these steps. Plain f64 loops of equation 13 are timed for comparison. `density`
//! times one segment by its fraction of nonzero numbers.
//!
//! Measured once on two quiet cores: 46 ms, compared with 458 ms for plain loops on one core; representatives: 23 ms,
//! 211 MB.
//!
//! The data are random, because compression would take an hour and the frame time does not depend on the values.
//!
//! `cargo bench -p crossbar-benches --bench all_frequency`

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput};
use crossbar::all_frequency::code::{CodeOptions, CodedSegment, CodedTransfer, SparseRows};
use crossbar::all_frequency::shade::{Multiplies, Shader, plain};
use crossbar::geom::random::CounterRng;

const VERTICES: usize = 51_300;
const TERMS: usize = 10;
const VECTORS: usize = 16;
const COEFFICIENTS: usize = 256;
const SEGMENTS: usize = 24;
/// Clusters per segment: 3,801 / 24.
const CLUSTERS: usize = 158;
/// Vertices with a given segment: 61.8 %.
const FILLED: usize = 31_703;
/// Density of nonzeros after the paper's wavelet transform: two fifths.
const DENSITY: f64 = 0.4;

/// A segment that is present at every vertex of a run; clusters are assigned to vertices in turn.
fn segment(segment: usize, filled: usize, clusters: usize, density: f64) -> CodedSegment {
    let random = CounterRng::new(segment as u64);
    let rows = clusters * VECTORS;
    let number = |at: usize| {
        let bits = random.bits(at as u64, 0, 0);
        let is_kept = (bits >> 40) as f64 / 16_777_216.0 < density;
        if is_kept { ((bits & 0xffff) as u16).cast_signed() | 1 } else { 0 }
    };
    let values: Vec<i16> = (0..rows * TERMS * COEFFICIENTS).map(number).collect();
    let weight = |at: usize| (random.bits(at as u64, 1, 0) as u16).cast_signed();
    let first = segment * (VERTICES - filled) / SEGMENTS;
    CodedSegment {
        segment,
        vertices: (first..first + filled).map(|vertex| vertex as u32).collect(),
        cluster_of: (0..filled).map(|at| (at / 200 % clusters) as u16).collect(),
        counts: vec![VECTORS as u8; clusters],
        representatives: SparseRows::encode(&values, TERMS * COEFFICIENTS),
        representative_steps: vec![1e-5; rows],
        weights: (0..filled * VECTORS).map(weight).collect(),
        weight_steps: vec![1e-5; rows],
    }
}

fn coded(segments: Vec<CodedSegment>) -> CodedTransfer {
    let options = CodeOptions::default();
    CodedTransfer { rows: TERMS, coefficients: COEFFICIENTS, vertices: VERTICES, options, segments }
}

fn light() -> Vec<[f32; 3]> {
    let random = CounterRng::new(99);
    let one = |at: usize| [0, 1, 2].map(|channel| random.unit(at as u64, 0, channel) as f32 - 0.5);
    (0..SEGMENTS * COEFFICIENTS).map(one).collect()
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let light = light();
    let teapot = coded((0..SEGMENTS).map(|at| segment(at, FILLED, CLUSTERS, DENSITY)).collect());
    let mut group = criterion.benchmark_group("teapot");
    group.sample_size(10).warm_up_time(Duration::from_millis(200));
    let shader = Shader::new(&teapot);
    let Multiplies { per_cluster, per_vertex } = shader.multiplies(&light);
    // The size is part of the name, so that it is reported with the time.
    let label = format!("{} MB", teapot.size().total() / 1_000_000);
    group.throughput(Throughput::Elements(per_cluster));
    group.bench_function(BenchmarkId::new("clusters", label), |bench| {
        bench.iter(|| black_box(shader.per_cluster(&light).expect("products")));
    });
    let products = shader.per_cluster(&light).expect("products");
    group.throughput(Throughput::Elements(per_vertex));
    group.bench_function("vertices", |bench| bench.iter(|| black_box(shader.weighted(&products))));
    group.throughput(Throughput::Elements(per_cluster + per_vertex));
    group.bench_function("steps 2 and 3", |bench| {
        bench.iter(|| black_box(shader.transferred(&light).expect("radiance")));
    });
    let exact: Vec<[f64; 3]> = light.iter().map(|rgb| rgb.map(f64::from)).collect();
    group.bench_function("plain loops in f64", |bench| {
        bench.iter(|| black_box(plain::transferred(&teapot, &exact).expect("radiance")));
    });
    group.finish();
    drop(teapot);
    let mut group = criterion.benchmark_group("density");
    group.sample_size(10).warm_up_time(Duration::from_millis(100)).measurement_time(Duration::from_secs(1));
    for percent in [5, 20, 40, 60, 80, 100] {
        let one = coded(vec![segment(0, FILLED, CLUSTERS, f64::from(percent) / 100.0)]);
        let shader = Shader::new(&one);
        group.throughput(Throughput::Elements(shader.multiplies(&light).per_cluster));
        group.bench_function(BenchmarkId::new("clusters", percent), |bench| {
            bench.iter(|| black_box(shader.per_cluster(&light).expect("products")));
        });
    }
    group.finish();
    criterion.final_summary();
}
