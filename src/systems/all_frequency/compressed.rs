//! Each lighting segment's transfer as clusters of linear combinations (section 5 of the paper, equation 11).

use crate::clustering::{
    Clustering, Compression, CpcaError, CpcaForm, CpcaMethod, CpcaOptions, CpcaStep, Signal, compress,
};
use crate::error::{InputError, ensure, input_error};

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
    ) -> Result<Self, CpcaError> {
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

/// Compressed transfer of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct CompressedTransfer {
    /// The number m of rows of a transfer matrix.
    pub rows: usize,
    /// Number of vertices of the mesh.
    pub vertices: usize,
    /// The segments with transfer at some vertex, in increasing order.
    pub segments: Vec<CompressedSegment>,
}

impl CompressedTransfer {
    /// Creates compressed transfer, and checks its parts.
    pub fn new(rows: usize, vertices: usize, segments: Vec<CompressedSegment>) -> Result<Self, InputError> {
        let mut before: Option<(usize, usize)> = None;
        for part in &segments {
            let (segment, found, points) = (part.segment, part.clustering.dimension(), part.clustering.points());
            ensure!(
                rows != 0 && found.is_multiple_of(rows),
                "segment {segment}: expected a multiple of {rows} numbers per vertex, one per row, found {found}"
            );
            if let Some((_, expected)) = before.filter(|&(last, size)| last >= segment || size != found) {
                return Err(input_error!(
                    "expected segments of {expected} numbers in increasing order, found segment {segment} of {found}"
                ));
            }
            before = Some((segment, found));
            let increasing = part.vertices.is_sorted_by(|a, b| a < b);
            let within = part.vertices.last().is_none_or(|&last| (last as usize) < vertices);
            ensure!(
                part.vertices.len() == points && increasing && within,
                "segment {segment}: expected {points} vertices below {vertices} in increasing order, found another list"
            );
            let zero = |value: &f64| *value == 0.0;
            ensure!(
                part.clustering.subspaces().iter().all(|cluster| cluster.mean.iter().all(zero)),
                "segment {segment}: expected clusters of the linear form, whose means are 0, found other means"
            );
        }
        Ok(Self { rows, vertices, segments })
    }

    /// Number n of light coefficients per segment; 0 if there are no segments.
    pub fn coefficients(&self) -> usize {
        self.segments.first().map_or(0, |first| first.clustering.dimension() / self.rows)
    }

    /// The paper's omega: the mean, over `segments` segments, of the fraction of vertices at which the segment is not
    /// 0.
    pub fn omega(&self, segments: usize) -> f64 {
        let filled: usize = self.segments.iter().map(|part| part.vertices.len()).sum();
        filled as f64 / (segments * self.vertices) as f64
    }
}
