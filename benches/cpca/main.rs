//! Host speed of compressing signals: order-5 diffuse transfer (25 numbers per point) compared with plain loops, and
//! glossy transfer (24 x 25 numbers).
//!
//! Figure to beat: ten times the speed of the plain loops on two threads. Ratios compare times of one run. An element
//! is one point.
//!
//! `cargo bench -p crossbar-benches --bench cpca`

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput};
use crossbar::clustering::{CpcaForm, CpcaMethod, CpcaOptions, Signal, compress, paper};
use crossbar::transfer::synthetic::torus_signal;

/// Points of both signals.
const POINTS: usize = 3000;

fn options(clusters: usize, vectors: usize) -> CpcaOptions {
    CpcaOptions {
        clusters,
        vectors,
        vq_iterations: 3,
        iterations: 3,
        method: CpcaMethod::Iterative,
        form: CpcaForm::Affine,
        seed: 1,
    }
}

fn fast(signal: &Signal, options: &CpcaOptions) -> f64 {
    compress(signal, options, |_| ()).expect("compressed").clustering.squared_error(signal)
}

fn main() {
    let mut criterion = Criterion::default().sample_size(10).configure_from_args();
    let mut group = criterion.benchmark_group("compression");
    group.throughput(Throughput::Elements(POINTS as u64));
    let (diffuse, diffuse_options) = (torus_signal(POINTS, 25, 1), options(64, 4));
    group.bench_function(BenchmarkId::new("diffuse", "fast"), |bench| {
        bench.iter(|| black_box(fast(&diffuse, &diffuse_options)));
    });
    group.bench_function(BenchmarkId::new("diffuse", "plain loops"), |bench| {
        bench.iter(|| black_box(paper::compress(&diffuse, &diffuse_options).expect("compressed")));
    });
    let (glossy, glossy_options) = (torus_signal(POINTS, 600, 1), options(16, 4));
    group.bench_function(BenchmarkId::new("glossy", "fast"), |bench| {
        bench.iter(|| black_box(fast(&glossy, &glossy_options)));
    });
    group.finish();
    criterion.final_summary();
}
