//! Compressed transfer: its accuracy.

use crossbar::all_frequency::Reflectance;
use crossbar::all_frequency::code::{CodeOptions, CodedSegment, CodedTransfer};
use crossbar::all_frequency::compressed::{CompressedSegment, SegmentOptions};
use crossbar::all_frequency::transfer::{TransferSegment, transfer_of};
use crossbar::transfer::Vertices;
use crossbar::transfer::linear_basis::{BasisWidth, LinearBasis};
use crossbar::transfer::visibility::VisibilityMaps;

use super::{all, close, clutter, factors, trace, vertices};

/// All segments of the transfer of some maps.
pub(super) fn segments(vertices: &Vertices, maps: &VisibilityMaps, reflectance: &Reflectance) -> Vec<TransferSegment> {
    let hats = LinearBasis::new(BasisWidth::TwoTexels);
    transfer_of(vertices, maps, &hats, reflectance).segments().map(|segment| segment.expect("transfer")).collect()
}

/// The transfer of some maps, in clusters of 10 vertices, coded.
pub(super) fn coded(
    vertices: &Vertices,
    maps: &VisibilityMaps,
    reflectance: &Reflectance,
    vectors: usize,
    options: CodeOptions,
) -> CodedTransfer {
    let parts = segments(vertices, maps, reflectance).into_iter();
    let segments = parts.map(|part| CodedSegment::code(&compressed(part, vectors), options).expect("coded")).collect();
    CodedTransfer { rows: reflectance.terms(), coefficients: 256, vertices: vertices.len(), options, segments }
}

fn compressed(part: TransferSegment, vectors: usize) -> CompressedSegment {
    let options = SegmentOptions { points_per_cluster: 10, vectors, ..SegmentOptions::default() };
    CompressedSegment::new(part.segment, part.vertices, &part.signal, &options, |_| ()).expect("compressed")
}

#[test]
fn as_many_vectors_as_members_leave_the_matrices_themselves() {
    let mesh = clutter(5, 14, 1.5);
    let vertices = vertices(&mesh);
    let maps = trace(&mesh, &vertices, &all(&vertices));
    for reflectance in [Reflectance::Diffuse, Reflectance::Factored(factors(4))] {
        let parts = segments(&vertices, &maps, &reflectance);
        assert!(parts.iter().any(|part| part.signal.sum_of_squares() > 0.0), "some transfer");
        for part in parts {
            let signal = part.signal.clone();
            let clustering = compressed(part, vertices.len()).clustering;
            // A dropped eigenvalue is at most 2^-44 of the largest, so at most 42 of them leave sqrt(42) 2^-22 = 1.6e-6
            // in length.
            let bound = 2e-6 * signal.sum_of_squares().sqrt();
            let mut found = vec![0.0; signal.dimension()];
            for point in 0..signal.points() {
                clustering.approximation(point, &mut found);
                for (found, &expected) in found.iter().zip(signal.point(point)) {
                    close(*found, f64::from(expected), bound, "a number");
                }
            }
        }
    }
}
