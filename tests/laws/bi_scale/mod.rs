//! System 6: transfer to local directions, its biclusters, light in harmonics, files.

mod biclusters;
mod file;
mod low_frequency;
mod shade;
mod texture;
mod transfer;

use crossbar::bi_scale::bicluster::{Biclustering, bicluster};
use crossbar::bi_scale::matrix::{MatrixEntry, SparseMatrix};
use crossbar::geom::Sides;
use crossbar::io::CoordinateMatrix;
use crossbar::tracer::HostTracer;
use crossbar::transfer::synthetic::hills;
use crossbar::transfer::visibility::{Horizon, VisibilityMaps, VisibilitySampling};
use crossbar::transfer::{Tangents, Vertices};
use proptest::prelude::*;

fn matrix(rows: &[Vec<i32>], fraction_bits: u32) -> SparseMatrix {
    let mut matrix = SparseMatrix::new(rows[0].len(), fraction_bits).expect("columns");
    for row in rows {
        let entries = (0..).zip(row).filter(|(_, value)| **value != 0);
        let entries: Vec<MatrixEntry> = entries.map(|(index, &value)| MatrixEntry { index, value }).collect();
        matrix.push_row(&entries).expect("a row");
    }
    matrix
}

fn real_matrix(rows: &[Vec<f64>]) -> SparseMatrix {
    let entry = |row: usize| (0..).zip(&rows[row]).map(move |(column, &value)| (row as u32, column, value));
    let entries = (0..rows.len()).flat_map(entry).collect();
    let matrix = CoordinateMatrix { rows: rows.len(), columns: rows[0].len(), entries };
    SparseMatrix::from_coordinates(&matrix).expect("finite numbers")
}

/// The numbers of a matrix, zeros included.
fn numbers_of(matrix: &SparseMatrix) -> Vec<Vec<f64>> {
    let row = |row: usize| {
        let mut numbers = vec![0.0; matrix.columns()];
        matrix.row(row).iter().for_each(|entry| numbers[entry.index as usize] = matrix.value(entry.value));
        numbers
    };
    (0..matrix.rows()).map(row).collect()
}

/// The bits of numbers; zeros of both signs are equal.
fn bits(rows: &[Vec<f64>]) -> Vec<Vec<u64>> {
    rows.iter().map(|row| row.iter().map(|value| (value + 0.0).to_bits()).collect()).collect()
}

/// Rows of multiples of a quarter that tend to form blocks: each takes one of a few patterns and changes some values.
fn blocks() -> impl Strategy<Value = Vec<Vec<i32>>> {
    let value = || prop_oneof![5 => Just(0), 3 => Just(4), 1 => 1..4_i32];
    (1..15_usize, 1..12_usize).prop_flat_map(move |(rows, columns)| {
        let patterns = prop::collection::vec(prop::collection::vec(value(), columns), 1..4);
        let changes = prop::collection::vec(prop_oneof![6 => Just(None), 1 => value().prop_map(Some)], rows * columns);
        let choice = prop::collection::vec(any::<prop::sample::Index>(), rows);
        (patterns, changes, choice).prop_map(move |(patterns, changes, choice)| {
            let row = |row: usize| {
                let pattern = &patterns[choice[row].index(patterns.len())];
                (0..columns).map(|at| changes[row * columns + at].unwrap_or(pattern[at])).collect()
            };
            (0..rows).map(row).collect()
        })
    })
}

/// Any number whose sums are finite: all bit patterns equally likely, near 1, or at the limits of the range.
fn finite() -> impl Strategy<Value = f64> {
    let ends = [1e303, -1e303, f64::MIN_POSITIVE, f64::from_bits(1), 1e300, 1e-300, 0.1, -0.1, 1.0];
    prop_oneof![
        2 => any::<u64>().prop_map(f64::from_bits).prop_filter("finite sums", |value| value.abs() <= 1e303),
        2 => -1.0..1.0_f64,
        1 => prop::sample::select(ends.to_vec()),
    ]
}

/// Blocks of a few numbers, with other numbers among them.
fn real_blocks() -> impl Strategy<Value = Vec<Vec<f64>>> {
    let others = prop::collection::vec(prop_oneof![8 => Just(None), 1 => finite().prop_map(Some)], 15 * 12);
    (blocks(), prop::collection::vec(finite(), 4), others).prop_map(|(rows, numbers, others)| {
        let number = |value: i32| if value == 0 { 0.0 } else { numbers[value as usize - 1] };
        let row = |(at, row): (usize, &Vec<i32>)| {
            row.iter().enumerate().map(|(column, &value)| others[12 * at + column].unwrap_or(number(value))).collect()
        };
        rows.iter().enumerate().map(row).collect()
    })
}

fn quietly(matrix: &SparseMatrix, seed: u64) -> Biclustering {
    bicluster(matrix, seed, &mut |_| ()).expect("small values")
}

/// A mesh of hills that occlude each other, and its visibility.
fn sight(log2_samples: u32, horizon: Horizon) -> (Vertices, VisibilityMaps) {
    let mesh = hills(3);
    let vertices = Vertices::new(&mesh, Tangents::Any).expect("vertices");
    let all: Vec<u32> = (0..vertices.len() as u32).collect();
    let mut caster = HostTracer::new(&mesh, Sides::Both);
    let sampling = VisibilitySampling { log2_samples, horizon };
    let maps = VisibilityMaps::trace_sampled(&vertices, &all, sampling, &mut caster, &mut |_, _| ());
    (vertices, maps.expect("maps"))
}
