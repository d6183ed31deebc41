//! Compressed transfer: its accuracy.

use crossbar::all_frequency::Reflectance;
use crossbar::all_frequency::compressed::{CompressedSegment, CompressedTransfer, SegmentOptions};
use crossbar::all_frequency::shade::plain;
use crossbar::all_frequency::transfer::{TransferSegment, transfer_of};
use crossbar::transfer::Vertices;
use crossbar::transfer::grid::Segmentation;
use crossbar::transfer::light::{CubeLight, HaarLight};
use crossbar::transfer::linear_basis::{BasisWidth, LinearBasis};
use crossbar::transfer::visibility::VisibilityMaps;

use super::{all, close, clutter, factors, trace, vertices};

/// All segments of the transfer of some maps.
pub(super) fn segments(vertices: &Vertices, maps: &VisibilityMaps, reflectance: &Reflectance) -> Vec<TransferSegment> {
    let hats = LinearBasis::new(BasisWidth::TwoTexels);
    transfer_of(vertices, maps, &hats, reflectance).segments().map(|segment| segment.expect("transfer")).collect()
}

/// The segments of the transfer of some maps, compressed in clusters of 10 vertices.
pub(super) fn compressed(
    vertices: &Vertices,
    maps: &VisibilityMaps,
    reflectance: &Reflectance,
    vectors: usize,
) -> CompressedTransfer {
    let options = SegmentOptions { points_per_cluster: 10, vectors, ..SegmentOptions::default() };
    let parts = segments(vertices, maps, reflectance).into_iter().map(|part| {
        CompressedSegment::new(part.segment, part.vertices, &part.signal, &options, |_| ()).expect("compressed")
    });
    CompressedTransfer::new(reflectance.terms(), vertices.len(), parts.collect()).expect("transfer")
}

/// A light that differs from texel to texel.
fn light() -> HaarLight {
    let texel = |at: usize| [at % 7, at % 11, at % 3].map(|value| value as f64);
    HaarLight::new(&CubeLight::new((0..6144).map(texel).collect()).expect("a light"), Segmentation::Quarters)
}

#[test]
fn as_many_vectors_as_members_leave_the_matrices_themselves() {
    let mesh = clutter(5, 14, 1.5);
    let vertices = vertices(&mesh);
    let maps = trace(&mesh, &vertices, &all(&vertices));
    for reflectance in [Reflectance::Diffuse, Reflectance::Factored(factors(4))] {
        let rows = reflectance.terms();
        let transfer = compressed(&vertices, &maps, &reflectance, vertices.len());
        let light = light();
        let found = plain::transferred(&transfer, &light.coefficients()).expect("radiance");
        let mut expected = vec![[0.0; 3]; rows * vertices.len()];
        for part in segments(&vertices, &maps, &reflectance) {
            for (point, &vertex) in part.vertices.iter().enumerate() {
                for (row, matrix) in part.signal.point(point).chunks_exact(256).enumerate() {
                    for (channel, sum) in expected[vertex as usize * rows + row].iter_mut().enumerate() {
                        let light = light.segment(channel, part.segment);
                        *sum += matrix.iter().zip(light).map(|(&m, l)| f64::from(m) * l).sum::<f64>();
                    }
                }
            }
        }
        let most = expected.iter().flatten().fold(0.0_f64, |most, value| most.max(value.abs()));
        assert!(most > 1.0);
        for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
            // Eigenvalues of a cluster below 2^-44 times the largest are treated as rounding: in length a factor of
            // 2^-22.
            close(*found, *expected, 1e-5 * most, "radiance");
        }
    }
}
