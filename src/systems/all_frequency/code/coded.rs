//! Quantised (coded) transfer of a mesh.

use serde::{Deserialize, Serialize};

use super::quantise::{quantise, step};
use super::{CodeOptions, ScaleOf, SparseRows};
use crate::all_frequency::compressed::CompressedSegment;
use crate::clustering::Clustering;
use crate::error::InputError;

/// The coded transfer of one lighting segment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CodedSegment {
    /// The segment's index, from 0.
    pub segment: usize,
    /// The vertices at which the segment's transfer is not 0, in increasing order.
    pub vertices: Vec<u32>,
    /// The cluster of each of these vertices.
    pub cluster_of: Vec<u16>,
    /// Number of representatives of each cluster; they are stored cluster by cluster.
    pub counts: Vec<u8>,
    /// The representatives, one row each.
    pub representatives: SparseRows,
    /// Quantisation step of each representative's numbers.
    pub representative_steps: Vec<f32>,
    /// For each vertex, the weights of its cluster's representatives.
    pub weights: Vec<i16>,
    /// Quantisation step of each representative's weights.
    pub weight_steps: Vec<f32>,
}

/// Coded transfer of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct CodedTransfer {
    /// The number m of rows of a transfer matrix.
    pub rows: usize,
    /// The number n of light coefficients per segment.
    pub coefficients: usize,
    /// Number of vertices of the mesh.
    pub vertices: usize,
    /// Options of the quantisation.
    pub options: CodeOptions,
    /// The segments with transfer at some vertex, in increasing order.
    pub segments: Vec<CodedSegment>,
}

/// The size of coded transfer in bytes. Integers of fewer than 16 bits are counted as packed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CodeSize {
    /// Non-zero numbers of the representatives: one byte for the row, and the value.
    pub representatives: u64,
    /// Counts of non-zeros per column of a block.
    pub columns: u64,
    /// Quantised weights.
    pub weights: u64,
    /// Quantisation steps.
    pub steps: u64,
    /// The set of vertices of each segment, one bit per vertex, and the cluster of each vertex in it, 2 bytes.
    pub clusters: u64,
}

impl CodeSize {
    /// The sum of all parts.
    pub fn total(&self) -> u64 {
        self.as_the_paper_counts() + self.columns + self.steps + self.clusters
    }

    /// Bytes of representatives and weights alone, as in the paper's columns (docs/papers/all_frequency.md).
    pub fn as_the_paper_counts(&self) -> u64 {
        self.representatives + self.weights
    }
}

impl CodedTransfer {
    /// The first part that is inconsistent with the others, if there is one.
    pub fn fault(&self) -> Option<&'static str> {
        if self.options.check().is_err() {
            return Some("bits");
        }
        if !self.segments.is_sorted_by(|a, b| a.segment < b.segment) {
            return Some("order of segments");
        }
        self.segments.iter().find_map(|part| part.fault(self))
    }

    /// Returns the number of bytes of each part.
    pub fn size(&self) -> CodeSize {
        let mut size = CodeSize::default();
        let bytes = |count: usize, bits: u64| (count as u64 * bits).div_ceil(8);
        for part in &self.segments {
            let rows = &part.representatives;
            size.representatives += bytes(rows.nonzeros(), 8 + u64::from(self.options.representative_bits));
            size.columns += 2 * (rows.block_count() * rows.columns()) as u64;
            size.weights += bytes(part.weights.len(), u64::from(self.options.weight_bits));
            size.steps += match self.options.scale {
                ScaleOf::Representative => 8 * part.representative_steps.len() as u64,
                ScaleOf::Segment => 8,
            };
            size.clusters += bytes(self.vertices, 1) + 2 * part.vertices.len() as u64;
        }
        size
    }

    /// Number of clusters of all segments.
    pub fn clusters(&self) -> usize {
        self.segments.iter().map(|part| part.counts.len()).sum()
    }

    /// Number of non-zero numbers of the representatives, and number of all their numbers.
    pub fn nonzeros(&self) -> (usize, usize) {
        let count = |part: &CodedSegment| {
            let rows = &part.representatives;
            (rows.nonzeros(), rows.rows() * rows.columns())
        };
        self.segments.iter().map(count).fold((0, 0), |a, b| (a.0 + b.0, a.1 + b.1))
    }
}

impl CodedSegment {
    /// Quantises a compressed segment. Panics if it has more than 65,536 clusters, or a cluster more than 255 vectors.
    pub fn code(part: &CompressedSegment, options: CodeOptions) -> Result<Self, InputError> {
        options.check()?;
        let largest: Vec<f64> = vectors(&part.clustering).map(|row| largest(row.iter())).collect();
        Ok(Self::with_steps(part, options, steps(&largest, options.representative_bits, options.scale)))
    }

    /// Quantises a compressed segment with one absolute step for all representatives. Each representative is first
    /// multiplied by the root mean square of its weights, so that its weights are about 1; numbers beyond 16 bits are
    /// clamped. Weights are coded as in the options. Panics as [`Self::code`] does.
    pub fn code_in_steps(part: &CompressedSegment, step: f64, options: CodeOptions) -> Result<Self, InputError> {
        options.check()?;
        let sizes = mean_weights(&part.clustering, &firsts(&counts(&part.clustering)));
        let steps = sizes.into_iter().map(|size| if size > 0.0 { (step / size) as f32 } else { 0.0 });
        Ok(Self::with_steps(part, options, steps.collect()))
    }

    /// Quantises representatives with these steps, and weights as in the options.
    fn with_steps(part: &CompressedSegment, options: CodeOptions, representative_steps: Vec<f32>) -> Self {
        let clustering = &part.clustering;
        assert!(clustering.subspaces().len() <= 1 << 16, "clusters that 16 bits can number");
        let counts = counts(clustering);
        let firsts = firsts(&counts);
        let codes = vectors(clustering).zip(&representative_steps);
        let codes: Vec<i16> = codes.flat_map(|(row, &step)| row.iter().map(move |&v| quantise(v, step))).collect();

        let largest = largest_weights(clustering, &firsts, representative_steps.len());
        let weight_steps = steps(&largest, options.weight_bits, options.scale);
        let mut weights = Vec::with_capacity(clustering.all_weights().len());
        for (point, &cluster) in clustering.of_point().iter().enumerate() {
            let steps = &weight_steps[firsts[cluster as usize]..];
            weights.extend(clustering.weights(point).iter().zip(steps).map(|(&weight, &step)| quantise(weight, step)));
        }
        Self {
            segment: part.segment,
            vertices: part.vertices.clone(),
            cluster_of: clustering.of_point().iter().map(|&cluster| cluster as u16).collect(),
            counts,
            representatives: SparseRows::encode(&codes, clustering.dimension()),
            representative_steps,
            weights,
            weight_steps,
        }
    }

    fn fault(&self, all: &CodedTransfer) -> Option<&'static str> {
        let increasing = self.vertices.is_sorted_by(|a, b| a < b);
        if !increasing || self.vertices.last().is_none_or(|&last| last as usize >= all.vertices) {
            return Some("vertices of a segment");
        }
        let known = |&cluster: &u16| usize::from(cluster) < self.counts.len();
        if self.cluster_of.len() != self.vertices.len() || !self.cluster_of.iter().all(known) {
            return Some("clusters of vertices");
        }
        let sum = |counts: &mut dyn Iterator<Item = u8>| counts.map(usize::from).sum::<usize>();
        let rows = sum(&mut self.counts.iter().copied());
        let shape = (self.representatives.rows(), Some(self.representatives.columns()));
        if shape != (rows, all.rows.checked_mul(all.coefficients)) {
            return Some("representatives");
        }
        let steps = [&self.representative_steps, &self.weight_steps];
        let fits = |steps: &Vec<f32>| steps.len() == rows && steps.iter().all(|step| step.is_finite() && *step >= 0.0);
        if !steps.into_iter().all(fits) {
            return Some("steps");
        }
        let weights = sum(&mut self.cluster_of.iter().map(|&cluster| self.counts[usize::from(cluster)]));
        (self.weights.len() != weights).then_some("weights")
    }

    /// The index of each cluster's first representative.
    pub(in crate::all_frequency) fn firsts(&self) -> Vec<usize> {
        firsts(&self.counts)
    }
}

/// The representatives of all clusters, cluster by cluster.
fn vectors(clustering: &Clustering) -> impl Iterator<Item = &[f64]> {
    clustering.subspaces().iter().flat_map(|cluster| cluster.vectors())
}

fn counts(clustering: &Clustering) -> Vec<u8> {
    let counts = clustering.subspaces().iter().map(|cluster| u8::try_from(cluster.len()));
    counts.collect::<Result<_, _>>().expect("at most 255 vectors")
}

fn firsts(counts: &[u8]) -> Vec<usize> {
    let mut next = 0;
    let before = counts.iter().map(|&count| {
        next += usize::from(count);
        next - usize::from(count)
    });
    before.collect()
}

fn largest<'a>(values: impl Iterator<Item = &'a f64>) -> f64 {
    values.fold(0.0, |largest, value| largest.max(value.abs()))
}

fn largest_weights(clustering: &Clustering, firsts: &[usize], rows: usize) -> Vec<f64> {
    let mut most = vec![0.0_f64; rows];
    for (point, &cluster) in clustering.of_point().iter().enumerate() {
        let most = &mut most[firsts[cluster as usize]..];
        most.iter_mut().zip(clustering.weights(point)).for_each(|(most, weight)| *most = most.max(weight.abs()));
    }
    most
}

/// The root mean square weight on each representative.
fn mean_weights(clustering: &Clustering, firsts: &[usize]) -> Vec<f64> {
    let mut sums = vec![(0.0_f64, 0_u32); vectors(clustering).count()];
    for (point, &cluster) in clustering.of_point().iter().enumerate() {
        let sums = &mut sums[firsts[cluster as usize]..];
        for (sum, weight) in sums.iter_mut().zip(clustering.weights(point)) {
            *sum = (sum.0 + weight * weight, sum.1 + 1);
        }
    }
    sums.into_iter().map(|(squares, count)| (squares / f64::from(count.max(1))).sqrt()).collect()
}

/// The quantisation step of each representative, whose largest magnitude is in `most`.
pub(super) fn steps(most: &[f64], bits: u8, scale: ScaleOf) -> Vec<f32> {
    match scale {
        ScaleOf::Representative => most.iter().map(|&most| step(most, bits)).collect(),
        ScaleOf::Segment => vec![step(largest(most.iter()), bits); most.len()],
    }
}
