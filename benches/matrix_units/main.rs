//! Host speed of matrix products in matrix units, on one thread: 64 x 64 elements with K = 4096; 4 x 64 for units that
//! are computed product by product.
//!
//! Figure to beat: `mmasim` 2.1.1, 82 to 97 ns per product (a batch of 65,536 dot products, torch on one thread). The
//! aim is at most 2 ns of processor time per product. An element is one product.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use refsim::exec::batch::{MatrixColumns, MatrixRows};
use refsim::num::{matrix::MatrixUnit, random_word};
use std::hint::black_box;

const SIZE: usize = 64;
const DEPTH: usize = 4096;

/// Random numbers of the unit's first type, without infinities and NaN.
fn rows(unit: &MatrixUnit, seed: u64) -> MatrixRows {
    let element = unit.operands[0];
    let width = element.width();
    let code = |k: usize| u64::from(random_word(seed, k as u64)) & ((1 << width) - 1) & !(3 << (width - 3));
    let codes = (0..SIZE * DEPTH).map(code).collect();
    MatrixRows { element, length: DEPTH, codes, scales: Vec::new(), share: 1 }
}

fn matrix_units(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("matrix_units");
    group.sample_size(10);
    let fast = ["hopper_fp8_f32", "hopper_f16_f32", "ampere_f16_f32", "blackwell_f8f6f4_f32", "volta_f16_f16"];
    let slow = ["sync_fp8_f32", "cdna1_bf16", "cdna2_f16", "cdna3_fp8", "fma_f32"];
    for (names, height) in [(fast, SIZE), (slow, 4)] {
        group.throughput(Throughput::Elements((height * SIZE * DEPTH) as u64));
        for name in names {
            let unit = MatrixUnit::find(name).expect("a unit");
            let [a, b] = [1, 2].map(|seed| rows(&unit, seed));
            let c = vec![0; height * SIZE];
            let product = || MatrixColumns::new(unit, &b).multiply(&a, 0..height, 0, DEPTH, &c);
            group.bench_function(name, |bencher| bencher.iter(|| black_box(product())));
        }
    }
    group.finish();
}

criterion_group!(benches, matrix_units);
criterion_main!(benches);
