//! How fast signals are compressed: a signal of order-5 diffuse transfer (25 numbers per point) beside plain loops, and
//! one of glossy transfer (24 x 25 numbers).
//!
//! Figure to beat: ten times as fast as the plain loops on two threads. Ratios are of one run. One element is
//! one point.
//!
//! `cargo bench -p crossbar-benches --bench cpca`
//!
//! Beside NumPy, of which `by_products.py` does the same by matrix products; the figure to beat is a fifth of its
//! processor time at 25 numbers per point. `--signal` writes a signal that both read (`crossbar cpca show --arrays`
//! writes that of a model); then each compresses it, with one thread:
//!
//! ```text
//! cargo bench -p crossbar-benches --bench cpca -- --signal signal.npy 29394 25
//! time RAYON_NUM_THREADS=1 cargo bench -p crossbar-benches --bench cpca -- --beside signal.npy 256 8 10
//! OPENBLAS_NUM_THREADS=1 python benches/cpca/by_products.py signal.npy 256 8 10
//! ```

use std::fs::{self, File};
use std::hint::black_box;
use std::path::Path;

use criterion::{BenchmarkId, Criterion, Throughput};
use crossbar::io::{parse_npy, write_npy_array};
use crossbar::transfer::Signal;
use crossbar::transfer::clustering::{CpcaForm, CpcaMethod, CpcaOptions, StartPoints, compress, reference};
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
        start: StartPoints::Seed(1),
    }
}

fn fast(signal: &Signal, options: &CpcaOptions) -> f64 {
    compress(signal, options, |_| ()).expect("compressed").clustering.squared_error(signal)
}

fn number(argument: &str) -> usize {
    argument.parse().expect("a number")
}

/// Writes a signal: file, points, dimension.
fn write_signal([file, points, dimension]: [&str; 3]) {
    let (points, dimension) = (number(points), number(dimension));
    let mut out = File::create(file).expect("a file");
    let signal = torus_signal(points, dimension, 1);
    write_npy_array(&[points, dimension], signal.values(), &mut out).expect("written");
}

/// Compresses a signal once: file, clusters, vectors, iterations.
#[expect(clippy::print_stdout, reason = "the error is compared with that of by_products.py")]
fn beside([file, clusters, vectors, iterations]: [&str; 4]) {
    let (clusters, vectors, iterations) = (number(clusters), number(vectors), number(iterations));
    let bytes = fs::read(file).expect("a signal");
    let table = parse_npy::<f32>(&bytes, Path::new(file)).expect("an array of two axes");
    let signal = Signal::new(table.columns, table.values).expect("a signal");
    let points = signal.points();
    let start = StartPoints::Given((0..clusters).map(|cluster| (cluster * points / clusters) as u32).collect());
    let options = CpcaOptions { vq_iterations: iterations, iterations, start, ..options(clusters, vectors) };
    println!("error {:.12e}", fast(&signal, &options));
}

fn main() {
    // Cargo adds `--bench`.
    let arguments: Vec<String> = std::env::args().filter(|argument| argument != "--bench").collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [.., "--signal", file, points, dimension] => return write_signal([file, points, dimension]),
        [.., "--beside", file, clusters, vectors, iterations] => return beside([file, clusters, vectors, iterations]),
        _ => {}
    }
    let mut criterion = Criterion::default().sample_size(10).configure_from_args();
    let mut group = criterion.benchmark_group("compression");
    group.throughput(Throughput::Elements(POINTS as u64));
    let (diffuse, diffuse_options) = (torus_signal(POINTS, 25, 1), options(64, 4));
    group.bench_function(BenchmarkId::new("diffuse", "fast"), |bench| {
        bench.iter(|| black_box(fast(&diffuse, &diffuse_options)));
    });
    group.bench_function(BenchmarkId::new("diffuse", "plain loops"), |bench| {
        bench.iter(|| black_box(reference::compress(&diffuse, &diffuse_options).expect("compressed")));
    });
    let (glossy, glossy_options) = (torus_signal(POINTS, 600, 1), options(16, 4));
    group.bench_function(BenchmarkId::new("glossy", "fast"), |bench| {
        bench.iter(|| black_box(fast(&glossy, &glossy_options)));
    });
    group.finish();
    criterion.final_summary();
}
