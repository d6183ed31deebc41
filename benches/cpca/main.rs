//! How fast signals are compressed: a signal of order-5 diffuse transfer (25 numbers per point) beside plain loops, and
//! one of glossy transfer (24 x 25 numbers).
//!
//! Figure to beat: ten times as fast as the plain loops on two threads. Ratios are of one run. One element is
//! one point.
//!
//! `cargo bench -p crossbar-benches --bench cpca`
//!
//! Beside NumPy, of which `by_products.py` does the same by matrix products; the figure to beat is a fifth of its
//! processor time at 25 numbers per point. Here the first line writes what both read, and compresses it under the
//! caller's clock, with one thread:
//!
//! ```text
//! time RAYON_NUM_THREADS=1 cargo bench -p crossbar-benches --bench cpca -- --beside signal.npy 29394 25 256 8 10
//! OPENBLAS_NUM_THREADS=1 python benches/cpca/by_products.py signal.npy 256 8 10
//! ```

use std::fs::File;
use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput};
use crossbar::io::write_npy_array;
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

/// Writes a signal and compresses it once: file, points, dimension, clusters, vectors, iterations.
#[expect(clippy::print_stdout, reason = "the error is compared with that of by_products.py")]
fn beside([file, numbers @ ..]: &[String; 6]) {
    let [points, dimension, clusters, vectors, iterations] =
        numbers.each_ref().map(|number| number.parse().expect("a number"));
    let signal = torus_signal(points, dimension, 1);
    let mut out = File::create(file).expect("a file");
    write_npy_array(&[points, dimension], signal.values(), &mut out).expect("written");
    let start = StartPoints::Given((0..clusters).map(|cluster| (cluster * points / clusters) as u32).collect());
    let options = CpcaOptions { vq_iterations: iterations, iterations, start, ..options(clusters, vectors) };
    println!("error {:.12e}", fast(&signal, &options));
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip_while(|argument| argument != "--beside").skip(1).collect();
    if let Some(arguments) = arguments.first_chunk() {
        return beside(arguments);
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
