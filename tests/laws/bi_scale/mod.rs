//! System 6: transfer to local directions, biclusters of it, other ways to store it, files.

mod biclusters;
mod file;
mod rivals;
mod shade;
mod texture;
mod transfer;

use crossbar::bi_scale::bicluster::{BiclusterOptions, Biclustering, bicluster};
use crossbar::bi_scale::matrix::{MatrixEntry, SparseMatrix};
use crossbar::geom::Sides;
use crossbar::tracer::HostTracer;
use crossbar::transfer::synthetic::hills;
use crossbar::transfer::visibility::{Horizon, VisibilityMaps, VisibilitySampling};
use crossbar::transfer::{Tangents, Vertices};

/// A matrix of the values of its rows.
fn matrix(rows: &[Vec<i32>], fraction_bits: u32) -> SparseMatrix {
    let mut matrix = SparseMatrix::new(rows[0].len(), fraction_bits).expect("columns");
    for row in rows {
        let entries = (0..).zip(row).filter(|(_, value)| **value != 0);
        let entries: Vec<MatrixEntry> = entries.map(|(index, &value)| MatrixEntry { index, value }).collect();
        matrix.push_row(&entries).expect("a row");
    }
    matrix
}

fn quietly(matrix: &SparseMatrix, options: BiclusterOptions) -> Biclustering {
    bicluster(matrix, options, &mut |_| ()).expect("small values")
}

/// Hills that hide each other, and what they see.
fn sight(log2_samples: u32, horizon: Horizon) -> (Vertices, VisibilityMaps) {
    let mesh = hills(3);
    let vertices = Vertices::new(&mesh, Tangents::Any).expect("vertices");
    let all: Vec<u32> = (0..vertices.len() as u32).collect();
    let mut caster = HostTracer::new(&mesh, Sides::Both);
    let sampling = VisibilitySampling { log2_samples, horizon };
    let maps = VisibilityMaps::trace_sampled(&vertices, &all, sampling, &mut caster, &mut |_, _| ());
    (vertices, maps.expect("maps"))
}
