//! Factors of reflectance, coded transfer, and its products with light on the host and on cards.

mod card;
mod code;
mod factors;
mod kernels;
mod lobes;
mod shade;
mod tables;

use crossbar_systems::all_frequency::compressed::{CompressedSegment, CompressedTransfer, SegmentOptions};
use crossbar_systems::transfer::synthetic::torus_signal;

/// Transfer of some of 40 vertices in segments 1 and 4, with m rows of n numbers, in 3 clusters and 1 cluster of up to
/// 4 vectors.
fn sample(rows: usize, coefficients: usize) -> CompressedTransfer {
    let options = SegmentOptions { points_per_cluster: 10, vectors: 4, iterations: 4, ..SegmentOptions::default() };
    let segment = |segment: usize, vertices: Vec<u32>| {
        let signal = torus_signal(vertices.len(), rows * coefficients, segment as u64);
        CompressedSegment::new(segment, vertices, &signal, &options, |_| ()).expect("compressed")
    };
    let segments = vec![segment(1, (0..30).collect()), segment(4, (5..40).step_by(3).collect())];
    CompressedTransfer::new(rows, 40, segments).expect("transfer")
}

#[test]
fn parts_must_go_together() {
    let good = sample(2, 8);
    assert_eq!((good.coefficients(), good.omega(24)), (8, 42.0 / (24.0 * 40.0)));
    let refused = |change: &dyn Fn(&mut CompressedTransfer)| {
        let mut transfer = good.clone();
        change(&mut transfer);
        let error = CompressedTransfer::new(transfer.rows, transfer.vertices, transfer.segments);
        error.expect_err("refused").to_string()
    };
    assert_eq!(
        refused(&|t| t.rows = 3),
        "segment 1: expected a multiple of 3 numbers per vertex, one per row, found 16"
    );
    assert_eq!(
        refused(&|t| t.segments.swap(0, 1)),
        "expected segments of 16 numbers in increasing order, found segment 1 of 16"
    );
    let vertices = |segment: usize, points: usize, vertices: usize| {
        format!(
            "segment {segment}: expected {points} vertices below {vertices} in increasing order, found another list"
        )
    };
    assert_eq!(refused(&|t| t.vertices = 38), vertices(4, 12, 38));
    assert_eq!(refused(&|t| t.segments[0].vertices[0] = 1), vertices(1, 30, 40));
}
