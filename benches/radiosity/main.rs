//! Host speed of matrix radiosity: an iteration over 4,096 patches on the batch executor compared with f32 loops, and
//! the f64 product of the host's solvers compared with nalgebra's.
//!
//! Figures to beat: the batch executor takes at most ten times the loop's time, and the product matches nalgebra's
//! matrix-vector product. Ratios compare times of one run. An element is one texel or element of the matrix.
//!
//! `cargo bench -p crossbar-benches --bench radiosity`; `-- "f64 product"` runs only the second, which needs less
//! memory (the first takes 1.5 GB).

use criterion::{BenchmarkId, Criterion, Throughput};
use crossbar::card::Texels;
use crossbar::geom::random::CounterRng;
use crossbar::linalg::Matrix;
use crossbar::radiosity::card_system::CardSystem;
use crossbar::radiosity::{CardSolver, FormFactors, Storage, System};
use nalgebra::{DMatrix, DVector};
use refsim::device::Profile;
use refsim::machine::ExecutorKind;
use std::hint::black_box;
use std::time::Duration;

/// Patches of the RGB iteration.
const PATCHES: usize = 4096;
/// Sizes of the products.
const SIZES: [usize; 3] = [512, 1954, 4096];

/// Random form factors, whose rows sum to 1.
fn factors(size: usize) -> Matrix {
    let random = CounterRng::new(size as u64);
    let mut matrix = Matrix::zeros([size; 2]).expect("a matrix");
    for i in 0..size {
        let row = matrix.row_mut(i);
        for (j, value) in row.iter_mut().enumerate() {
            *value = random.unit(i as u64, j as u64, 0);
        }
        let sum: f64 = row.iter().sum();
        row.iter_mut().for_each(|value| *value /= sum);
    }
    matrix
}

fn system(size: usize) -> System {
    let factors = FormFactors::from_values(vec![1.0; size], factors(size)).expect("form factors");
    let emittance = (0..size).map(|i| if i % 64 == 0 { [17.0, 12.0, 4.0] } else { [0.0; 3] }).collect();
    System::new(factors, vec![[0.7, 0.5, 0.3]; size], emittance).expect("a system")
}

/// Plain implementation of equation 4: row by row, three channels and one for padding, on one thread.
fn plain_step(matrix: &Texels, e: &Texels, b: &Texels) -> Vec<[f32; 4]> {
    (0..matrix.height)
        .map(|i| {
            let mut sum = [0, 1, 2, 3].map(|c| b.texels[i][c] + e.texels[i][c]);
            for (m, b) in matrix.row(i).iter().zip(&b.texels) {
                for c in 0..4 {
                    sum[c] -= m[c] * b[c];
                }
            }
            sum
        })
        .collect()
}

fn iterations(criterion: &mut Criterion) {
    let host = CardSystem::rgb(&system(PATCHES), 254, PATCHES).expect("it fits");
    let nv35 = Profile::named("nv35").expect("a card");
    let systems = std::slice::from_ref(&host);
    let mut card = CardSolver::of(nv35, ExecutorKind::Batch, systems, Storage::Fp32).expect("a card");
    card.iterate().expect("an iteration");
    let b = card.read_texels().expect("radiosities").remove(0);
    card.iterate().expect("an iteration");
    let bits = |texels: &[[f32; 4]]| texels.iter().map(|t| t.map(f32::to_bits)).collect::<Vec<_>>();
    let next = card.read_texels().expect("radiosities").remove(0);
    assert_eq!(bits(&plain_step(&host.matrix, &host.emittance, &b)), bits(&next.texels), "the plain loop");
    let mut group = criterion.benchmark_group("RGB iteration");
    group.sample_size(10).warm_up_time(Duration::from_millis(500)).measurement_time(Duration::from_secs(5));
    group.throughput(Throughput::Elements((PATCHES * PATCHES) as u64));
    group.bench_function(BenchmarkId::new("plain loop, one thread", PATCHES), |bencher| {
        bencher.iter(|| black_box(plain_step(&host.matrix, &host.emittance, black_box(&b))));
    });
    group.bench_function(BenchmarkId::new("batch executor, all threads", PATCHES), |bencher| {
        bencher.iter(|| card.iterate().expect("an iteration"));
    });
    group.finish();
}

fn products(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("f64 product");
    group.sample_size(20).warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(2));
    for size in SIZES {
        let ours = factors(size);
        let random = CounterRng::new(7);
        let vector: Vec<f64> = (0..size).map(|i| random.unit(i as u64, 0, 0)).collect();
        let theirs = DMatrix::from_fn(size, size, |i, j| ours.row(i)[j]);
        let column = DVector::from_column_slice(&vector);
        let product = &theirs * &column;
        for (a, b) in ours.times(&vector).iter().zip(product.iter()) {
            assert!((a - b).abs() <= 1e-12 * b.abs(), "the same product: {a} and {b}");
        }
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
        group.throughput(Throughput::Elements((size * size) as u64));
        group.bench_function(BenchmarkId::new("Matrix::times", size), |bencher| {
            bencher.iter(|| black_box(ours.times(black_box(&vector))));
        });
        group.bench_function(BenchmarkId::new("Matrix::times, one thread", size), |bencher| {
            pool.install(|| bencher.iter(|| black_box(ours.times(black_box(&vector)))));
        });
        group.bench_function(BenchmarkId::new("nalgebra", size), |bencher| {
            bencher.iter(|| black_box(black_box(&theirs) * black_box(&column)));
        });
    }
    group.finish();
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    products(&mut criterion);
    // Avoids building the matrices if a filter excludes the iterations.
    if !std::env::args().any(|argument| argument == "f64 product") {
        iterations(&mut criterion);
    }
    criterion.final_summary();
}
