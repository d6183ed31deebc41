//! Host speed of biclustering and of products with biclusters, on one thread: transfer matrix of the stand-in for the
//! paper's bunny (3,286 vertices, 6 x 32 x 32 light texels, 8 x 8 local directions).
//!
//! Figures to beat: light times the biclusters at least three times as fast as light times the matrix row by row, in
//! f32; biclusters of some ten million nonzeros in 24 s (the paper took 12 minutes). Ratios compare times of one run.
//! An element is one nonzero. Measured once on a quiet machine: 4.1 s; 1.33 ms compared with 4.36 ms for one channel
//! (3.3 times), 2.7 ms compared with 8.5 ms for three (3.1 times).
//!
//! `cargo bench -p crossbar-benches --bench bi_scale`; `-- --whole` runs biclustering once and prints its duration.

use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::{Criterion, Throughput};
use crossbar::bi_scale::bicluster::{Biclustering, SEED, bicluster};
use crossbar::bi_scale::directions::LocalDirections;
use crossbar::bi_scale::matrix::SparseMatrix;
use crossbar::bi_scale::product::Gather;
use crossbar::bi_scale::transfer::transfer_matrix;
use crossbar::geom::Sides;
use crossbar::scene::built::transfer_models::TransferModel;
use crossbar::tracer::HostTracer;
use crossbar::transfer::visibility::{Horizon, VisibilityMaps, VisibilitySampling};
use crossbar::transfer::{Tangents, Vertices};

/// Transfer matrix of a model whose edges are longer by the factor `coarser`.
fn matrix(coarser: u32) -> SparseMatrix {
    let mesh = TransferModel::BiScaleBunny.mesh(coarser);
    let vertices = Vertices::new(&mesh, Tangents::Texture).expect("vertices");
    let all: Vec<u32> = (0..vertices.len() as u32).collect();
    let sampling = VisibilitySampling { log2_samples: 1, horizon: Horizon::Normal };
    let mut caster = HostTracer::new(&mesh, Sides::Both);
    let maps = VisibilityMaps::trace_sampled(&vertices, &all, sampling, &mut caster, &mut |_, _| ()).expect("maps");
    transfer_matrix(&vertices, &maps, &LocalDirections::new(8).expect("a side")).expect("a matrix")
}

fn biclusters(matrix: &SparseMatrix) -> Biclustering {
    bicluster(matrix, SEED, &mut |_| ()).expect("quarters")
}

/// Rows of columns and values in f32, with the start of each row.
struct SingleRows {
    begins: Vec<u32>,
    columns: Vec<u32>,
    values: Vec<f32>,
}

impl SingleRows {
    fn new(matrix: &SparseMatrix) -> Self {
        let mut rows = Self { begins: vec![0], columns: Vec::new(), values: Vec::new() };
        for row in 0..matrix.rows() {
            rows.columns.extend(matrix.row(row).iter().map(|entry| entry.index));
            rows.values.extend(matrix.row(row).iter().map(|entry| matrix.value(entry.value) as f32));
            rows.begins.push(rows.columns.len() as u32);
        }
        rows
    }

    /// The products of a row are added to 0 in the order of columns.
    fn multiply<const C: usize>(&self, light: &[[f32; C]]) -> Vec<[f32; C]> {
        let row = |ends: &[u32]| {
            let of = ends[0] as usize..ends[1] as usize;
            let entries = self.columns[of.clone()].iter().zip(&self.values[of]);
            entries.fold([0.0; C], |sum, (&column, &value)| {
                let light = light[column as usize];
                std::array::from_fn(|channel| sum[channel] + value * light[channel])
            })
        };
        self.begins.windows(2).map(row).collect()
    }
}

/// Product with a light of C channels, by biclusters and by rows.
fn products<const C: usize>(criterion: &mut Criterion, rows: &SingleRows, gather: &Gather) {
    let light: Vec<[f32; C]> = (0..6144).map(|texel| [0; C].map(|_: u8| (texel % 97) as f32 / 97.0)).collect();
    let mut group = criterion.benchmark_group(format!("light of {C} channels"));
    group.sample_size(20).measurement_time(Duration::from_secs(3));
    group.throughput(Throughput::Elements(rows.columns.len() as u64));
    group.bench_function("times rows", |b| b.iter(|| black_box(rows.multiply(black_box(&light)))));
    group.bench_function("times biclusters", |b| b.iter(|| black_box(gather.multiply(black_box(&light)))));
    group.finish();
}

fn benches(criterion: &mut Criterion, matrix: &SparseMatrix, found: &Biclustering) {
    let (rows, gather) = (SingleRows::new(matrix), Gather::new(found));
    products::<1>(criterion, &rows, &gather);
    products::<3>(criterion, &rows, &gather);
    products::<4>(criterion, &rows, &gather);
    let small = self::matrix(4);
    let mut group = criterion.benchmark_group("biclusters");
    group.sample_size(10).throughput(Throughput::Elements(small.nonzeros() as u64));
    group.bench_function("203 vertices", |b| b.iter(|| black_box(biclusters(&small))));
    group.finish();
}

fn main() -> Result<(), rayon::ThreadPoolBuildError> {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global()?;
    let start = Instant::now();
    let matrix = matrix(1);
    let (nonzeros, made) = (matrix.nonzeros(), start.elapsed());
    let start = Instant::now();
    let found = biclusters(&matrix);
    let [rows, columns] = found.matrix_size();
    #[expect(clippy::print_stdout, reason = "what is measured once is said once")]
    {
        println!("T: {rows} x {columns}, {nonzeros} non-zeros, made in {made:.2?}");
        println!(
            "{} biclusters in {:.2?}: cost {} of {}, {} entries of rows, {} of columns",
            found.len(),
            start.elapsed(),
            found.cost(),
            2 * nonzeros,
            found.row_entries(),
            found.column_entries()
        );
    }
    if !std::env::args().any(|argument| argument == "--whole") {
        let mut criterion = Criterion::default().configure_from_args();
        benches(&mut criterion, &matrix, &found);
        criterion.final_summary();
    }
    Ok(())
}
