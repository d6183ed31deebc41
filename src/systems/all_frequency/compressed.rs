//! Each lighting segment's transfer as clusters of linear combinations (section 5 of the paper, equation 11).

use crate::clustering::{Clustering, Compression, CpcaForm, CpcaMethod, CpcaOptions, CpcaStep, Signal, compress};
use crate::error::InputError;

/// Options of the compression of segments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SegmentOptions {
    /// Vertices per cluster on average; the paper uses 200. The number of a segment's clusters is its number of
    /// vertices divided by this, rounded down, at least 1. Rounding up or to nearest agrees no better with Table 1
    /// (docs/papers/all_frequency.md).
    pub points_per_cluster: usize,
    /// Number n of representatives per cluster, at most the dimension of the signal; the paper uses 16.
    pub vectors: usize,
    /// Maximum number of iterations for each number of representatives.
    pub iterations: usize,
    /// The measure by which vertices are assigned to clusters; [`CpcaMethod::Iterative`] in the paper.
    pub method: CpcaMethod,
    /// Random seed of the start points, which differ between segments.
    pub seed: u64,
}

impl Default for SegmentOptions {
    fn default() -> Self {
        Self { points_per_cluster: 200, vectors: 16, iterations: 10, method: CpcaMethod::Iterative, seed: 1 }
    }
}

/// The transfer of one lighting segment at the vertices where it is not 0.
#[derive(Clone, Debug, PartialEq)]
pub struct CompressedSegment {
    /// The segment, counted from 0.
    pub segment: usize,
    /// The vertices in increasing order, one per point of the clustering.
    pub vertices: Vec<u32>,
    /// Clusters of the vertices' transfer: m x n numbers per vertex, n light coefficients for each of m rows. The means
    /// are 0.
    pub clustering: Clustering,
}

impl CompressedSegment {
    /// Compresses the transfer of a segment at those vertices where it is not 0. `observe` is called after each step.
    /// Panics if the number of vertices per cluster is 0, or the signal does not have one point per vertex.
    pub fn new(
        segment: usize,
        vertices: Vec<u32>,
        signal: &Signal,
        options: &SegmentOptions,
        observe: impl FnMut(&CpcaStep),
    ) -> Result<Self, InputError> {
        assert_eq!(vertices.len(), signal.points(), "a point for each vertex");
        let options = CpcaOptions {
            clusters: (signal.points() / options.points_per_cluster).max(1),
            vectors: options.vectors.min(signal.dimension()),
            vq_iterations: options.iterations,
            iterations: options.iterations,
            method: options.method,
            form: CpcaForm::Linear,
            seed: options.seed.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(segment as u64),
        };
        let Compression { clustering, .. } = compress(signal, &options, observe)?;
        Ok(Self { segment, vertices, clustering })
    }
}
