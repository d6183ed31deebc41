//! Segments of a model of Table 1, compressed and coded, and their sums.

use serde::{Deserialize, Serialize};

use super::codings::CODINGS;
use super::{HOST, RunResult, StudyError};
use crate::all_frequency::code::CodedTransfer;
use crate::all_frequency::compressed::{CompressedSegment, SegmentOptions};
use crate::all_frequency::transfer::TransferSegment;
use crate::clustering::{CpcaStep, CpcaStepKind, Signal};
use crate::transfer::grid::Segmentation;

/// Bits per number in the coding of Haar coefficients without clusters, as in the earlier work.
const HAAR_BITS: u32 = 8;

/// Results for a segment, or sums over several.
#[derive(Default, Serialize, Deserialize)]
pub(super) struct SegmentSums {
    /// Number of vertices with transfer in the segment.
    pub(super) points: usize,
    pub(super) clusters: usize,
    /// Number of numbers stored before coding.
    pub(super) numbers: usize,
    pub(super) squares: f64,
    /// Sums for each of [`CODINGS`].
    pub(super) coded: [CodeSums; CODINGS.len()],
    /// Bytes of nonzero quantised Haar coefficients.
    pub(super) haar: f64,
    /// Squared error by number of representatives.
    pub(super) error_of: Vec<(usize, f64)>,
}

/// Relative size and error of one segment, in the first of [`CODINGS`].
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct SegmentShares {
    pub(super) segment: usize,
    /// Size after coding, relative to the size after clustering.
    pub(super) coded: f64,
    /// Squared error relative to the sum of squares.
    pub(super) squared_error: f64,
}

#[derive(Clone, Copy, Default, Serialize, Deserialize)]
pub(super) struct CodeSums {
    /// Bytes of representatives and weights.
    pub(super) numbers: u64,
    /// Bytes of the numbers of columns, steps and clusters.
    pub(super) headers: u64,
    pub(super) squared_error: f64,
}

impl SegmentSums {
    /// Compresses and codes a segment of a model with `rows` rows per transfer matrix and `of_model` vertices.
    pub(super) fn new(
        TransferSegment { segment, vertices, signal }: TransferSegment,
        iterations: usize,
        (rows, of_model): (usize, usize),
    ) -> Result<Self, StudyError> {
        let options = SegmentOptions { iterations, ..SegmentOptions::default() };
        let mut steps: Vec<CpcaStep> = Vec::new();
        let compressed = CompressedSegment::new(segment, vertices, &signal, &options, |step| steps.push(*step));
        let compressed = compressed.on(HOST)?;
        let mut found = Self {
            points: signal.points(),
            clusters: compressed.clustering.subspaces().len(),
            numbers: compressed.clustering.stored_numbers(),
            squares: signal.sum_of_squares(),
            haar: haar_bytes(&signal),
            error_of: last_of_each(&steps),
            ..Self::default()
        };
        for (sums, coding) in found.coded.iter_mut().zip(CODINGS) {
            let coded = coding.code(&compressed)?;
            let squared_error = coded.squared_errors(&signal).iter().sum();
            let (coefficients, options) = (Segmentation::Quarters.len(), coding.options());
            let coded = CodedTransfer { rows, coefficients, vertices: of_model, options, segments: vec![coded] };
            let size = coded.size();
            let numbers = size.as_the_paper_counts();
            *sums = CodeSums { numbers, headers: size.total() - numbers, squared_error };
        }
        Ok(found)
    }

    pub(super) fn shares(&self, segment: usize) -> SegmentShares {
        let CodeSums { numbers, squared_error, .. } = self.coded[0];
        let coded = numbers as f64 / (4 * self.numbers) as f64;
        SegmentShares { segment, coded, squared_error: squared_error / self.squares }
    }

    /// Adds the results of another segment.
    pub(super) fn add(&mut self, other: &Self) {
        self.points += other.points;
        self.clusters += other.clusters;
        self.numbers += other.numbers;
        self.squares += other.squares;
        for (sum, other) in self.coded.iter_mut().zip(&other.coded) {
            sum.numbers += other.numbers;
            sum.headers += other.headers;
            sum.squared_error += other.squared_error;
        }
        self.haar += other.haar;
        self.error_of.resize(other.error_of.len().max(self.error_of.len()), (0, 0.0));
        for (sum, (vectors, error)) in self.error_of.iter_mut().zip(&other.error_of) {
            *sum = (*vectors, sum.1 + error);
        }
    }
}

/// Squared error of the last fit, for each number of representatives except 0.
fn last_of_each(steps: &[CpcaStep]) -> Vec<(usize, f64)> {
    let fits = steps.iter().filter(|step| step.kind == CpcaStepKind::Fitted && step.vectors > 0);
    let mut last: Vec<(usize, f64)> = Vec::new();
    for step in fits {
        match last.last_mut().filter(|last| last.0 == step.vectors) {
            Some(last) => last.1 = step.squared_error,
            None => last.push((step.vectors, step.squared_error)),
        }
    }
    last
}

/// Bytes of a segment without clusters: one for the row and one for the value of each coefficient that is nonzero after
/// quantisation. The vertex's largest coefficient gets the largest integer.
fn haar_bytes(signal: &Signal) -> f64 {
    let nonzeros = |point: usize| {
        let values = signal.point(point);
        let largest = values.iter().fold(0.0_f32, |largest, value| largest.max(value.abs()));
        let half = 0.5 * f64::from(largest) / f64::from((1_u32 << (HAAR_BITS - 1)) - 1);
        values.iter().filter(|value| f64::from(value.abs()) > half).count()
    };
    let nonzeros: usize = (0..signal.points()).map(nonzeros).sum();
    nonzeros as f64 * (1.0 + f64::from(HAAR_BITS) / 8.0)
}
