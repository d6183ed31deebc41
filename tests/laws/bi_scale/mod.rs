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
