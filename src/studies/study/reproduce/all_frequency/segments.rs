//! Segments of a model of Table 1, compressed and coded, and their sums; possible meanings of "16 bits".

use serde::{Deserialize, Serialize};

use super::{HOST, RunResult, StudyError};
use crate::all_frequency::code::{CodeOptions, CodedSegment, CodedTransfer, ScaleOf};
use crate::all_frequency::compressed::{CompressedSegment, SegmentOptions};
use crate::all_frequency::transfer::TransferSegment;
use crate::clustering::{CpcaStep, CpcaStepKind, Signal};
use crate::elementary::pow;
use crate::transfer::grid::Segmentation;

/// Number of codings of representatives: the largest number of a representative, as in the paper, or of a segment gets
/// the largest code; or absolute steps, for weights of about 1.
pub(super) const CODINGS: usize = 2 + STEPS.len();
/// Absolute steps 2^-(halves / 2).
const STEPS: [u8; 9] = [30, 31, 32, 33, 34, 35, 36, 37, 38];
/// The first coding with an absolute step.
pub(super) const ABSOLUTE: usize = CODINGS - STEPS.len();

/// "16 bits rather than 8".
pub(super) const BITS: u8 = 16;

/// Codes a segment, and returns the options with it.
fn code(part: &CompressedSegment, coding: usize) -> Result<(CodedSegment, CodeOptions), StudyError> {
    let scale = if coding == 1 { ScaleOf::Segment } else { ScaleOf::Representative };
    let options = CodeOptions { representative_bits: BITS, scale, ..CodeOptions::default() };
    let coded = match coding.checked_sub(ABSOLUTE) {
        None => CodedSegment::code(part, options),
        Some(at) => CodedSegment::code_in_steps(part, pow(2.0, -0.5 * f64::from(STEPS[at])), options),
    };
    Ok((coded.on(HOST)?, options))
}

/// Bits per number in the coding of Haar coefficients without clusters, as in the earlier work.
const HAAR_BITS: u32 = 8;

/// Results for a segment, or sums over several.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct SegmentSums {
    /// Number of vertices with transfer in the segment.
    pub(super) points: usize,
    pub(super) clusters: usize,
    /// Number of numbers stored before coding.
    pub(super) numbers: usize,
    pub(super) squares: f64,
    /// Sums for each of the [`CODINGS`].
    pub(super) coded: [CodeSums; CODINGS],
    /// Bytes of nonzero quantised Haar coefficients.
    pub(super) haar: f64,
    /// Squared error by number of representatives.
    pub(super) error_of: Vec<(usize, f64)>,
}

#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
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
        for (coding, sums) in found.coded.iter_mut().enumerate() {
            let (coded, options) = code(&compressed, coding)?;
            let squared_error = coded.squared_errors(&signal).iter().sum();
            let coefficients = Segmentation::Quarters.len();
            let coded = CodedTransfer { rows, coefficients, vertices: of_model, options, segments: vec![coded] };
            let size = coded.size();
            let numbers = size.as_the_paper_counts();
            *sums = CodeSums { numbers, headers: size.total() - numbers, squared_error };
        }
        Ok(found)
    }

    /// Size after coding relative to the size after clustering, and squared error relative to the sum of squares, in
    /// the first coding.
    pub(super) fn shares(&self) -> [f64; 2] {
        let CodeSums { numbers, squared_error, .. } = self.coded[0];
        [numbers as f64 / (4 * self.numbers) as f64, squared_error / self.squares]
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
