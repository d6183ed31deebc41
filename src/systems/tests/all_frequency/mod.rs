//! Factors of reflectance, coded transfer, and its products with light on the host and on cards.

mod card;
mod code;
mod factors;
mod kernels;
mod lobes;
mod shade;
mod tables;

use crossbar_systems::all_frequency::code::{CodeOptions, CodedSegment, CodedTransfer};
use crossbar_systems::all_frequency::compressed::{CompressedSegment, SegmentOptions};
use crossbar_systems::transfer::synthetic::torus_signal;

/// Transfer of some of 40 vertices in segments 1 and 4, with m rows of n numbers, in 3 clusters and 1 cluster of up to
/// 4 vectors.
fn sample(rows: usize, coefficients: usize) -> [CompressedSegment; 2] {
    let options = SegmentOptions { points_per_cluster: 10, vectors: 4, iterations: 4, ..SegmentOptions::default() };
    let segment = |segment: usize, vertices: Vec<u32>| {
        let signal = torus_signal(vertices.len(), rows * coefficients, segment as u64);
        CompressedSegment::new(segment, vertices, &signal, &options, |_| ()).expect("compressed")
    };
    [segment(1, (0..30).collect()), segment(4, (5..40).step_by(3).collect())]
}

/// [`sample`], coded.
fn coded(rows: usize, coefficients: usize, options: CodeOptions) -> CodedTransfer {
    let segments = sample(rows, coefficients).map(|part| CodedSegment::code(&part, options).expect("coded")).into();
    CodedTransfer { rows, coefficients, vertices: 40, options, segments }
}
