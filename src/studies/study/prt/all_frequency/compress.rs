//! Transfer computed, compressed and coded, one segment of the light at a time.

use std::ops::Range;
use std::time::Instant;

use serde::{Deserialize, Serialize};

use crate::all_frequency::Reflectance;
use crate::all_frequency::code::{CodeOptions, CodedSegment, CodedTransfer};
use crate::all_frequency::compressed::{CompressedSegment, SegmentOptions};
use crate::all_frequency::transfer::{TransferSegment, transfer_of};
use crate::clustering::CpcaError;
use crate::split::{Computed, Concatenate, KeptResults, SplitRun};
use crate::study::{ProgressFn, StudyError};
use crate::transfer::Vertices;
use crate::transfer::grid::Segmentation;
use crate::transfer::linear_basis::{BasisWidth, LinearBasis};
use crate::transfer::visibility::VisibilityMaps;

use super::tally::{CompressionTally, SegmentTally};

/// A finished segment: its code and errors, or `None` if its transfer is 0.
type FinishedSegment = Option<(CodedSegment, SegmentTally)>;

/// Finished segments of a range.
#[derive(Debug, Default, Serialize, Deserialize)]
struct FinishedSegments(Vec<FinishedSegment>);

impl Concatenate for FinishedSegments {
    fn are_of(&self, range: &Range<usize>) -> bool {
        let is = |(segment, found): (usize, &FinishedSegment)| {
            found.as_ref().is_none_or(|(coded, _)| coded.segment == segment)
        };
        self.0.are_of(range) && range.clone().zip(&self.0).all(is)
    }

    fn append(&mut self, next: Self) {
        self.0.extend(next.0);
    }
}

/// Transfer to be compressed, and options.
#[derive(Debug)]
pub struct SegmentedCompression<'a> {
    /// The vertices of the model.
    pub vertices: &'a Vertices,
    /// Visibility at each vertex.
    pub maps: &'a VisibilityMaps,
    /// The hats of the light's texels.
    pub hats: BasisWidth,
    /// The reflectance.
    pub reflectance: &'a Reflectance,
    /// Options of compression.
    pub options: SegmentOptions,
    /// Options of coding.
    pub code: CodeOptions,
    /// Folder of finished segments, and the prefix of their names.
    pub kept: Option<(&'a KeptResults, &'a str)>,
}

impl SegmentedCompression<'_> {
    /// Bytes of raw transfer in single precision, of all 24 segments at all vertices.
    pub fn raw_bytes(&self) -> u64 {
        let numbers = self.reflectance.terms() * Segmentation::Quarters.len() * Segmentation::Quarters.count();
        4 * self.vertices.len() as u64 * numbers as u64
    }

    /// Compresses and codes all segments. Fails if transfer cannot be computed, compressed or coded, or finished
    /// segments cannot be stored or read back.
    pub fn run(&self, progress: &mut ProgressFn<'_>) -> Result<(CodedTransfer, CompressionTally), StudyError> {
        let found = self.of_range(0..Segmentation::Quarters.count(), progress)?;
        Ok(self.whole(found))
    }

    /// Like [`Self::run`], for a whole run, for the segments of a part, or from merged parts. Fails as [`Self::run`]
    /// does, and with an [`InputError`](crate::error::InputError) if a part is invalid.
    pub fn run_split(
        &self,
        split: &SplitRun,
        progress: &mut ProgressFn<'_>,
    ) -> Result<Computed<(CodedTransfer, CompressionTally)>, StudyError> {
        let of_range = |range| self.of_range(range, progress);
        let found = match split.compute("segments", Segmentation::Quarters.count(), of_range)? {
            Computed::Whole(found) => found,
            Computed::Part(part) => return Ok(Computed::Part(part)),
        };
        let (coded, tally) = self.whole(found);
        match coded.fault() {
            None => Ok(Computed::Whole((coded, tally))),
            Some(fault) => {
                let what = format!("expected the segments of this transfer, found a contradiction in the {fault}");
                Err(StudyError::new("crossbar::prt::segments", what).with_help("compute all parts anew"))
            }
        }
    }

    fn of_range(&self, range: Range<usize>, progress: &mut ProgressFn<'_>) -> Result<FinishedSegments, StudyError> {
        let hats = LinearBasis::new(self.hats);
        let transfer = transfer_of(self.vertices, self.maps, &hats, self.reflectance);
        let finished = |segment: usize| {
            progress("segments", (segment - range.start) as u64, range.len() as u64);
            let compute = || {
                let start = Instant::now();
                let found = transfer.segment(segment)?;
                found.map(|found| self.segment(found, start.elapsed().as_secs_f64())).transpose()
            };
            match self.kept {
                Some((kept, name)) => kept.get(&format!("{name}segment-{segment:02}"), compute),
                None => compute(),
            }
        };
        range.clone().map(finished).collect::<Result<_, _>>().map(FinishedSegments)
    }

    fn whole(&self, found: FinishedSegments) -> (CodedTransfer, CompressionTally) {
        let (segments, tallies) = found.0.into_iter().flatten().unzip();
        let (rows, coefficients) = (self.reflectance.terms(), Segmentation::Quarters.len());
        let coded = CodedTransfer { rows, coefficients, vertices: self.vertices.len(), options: self.code, segments };
        (coded, CompressionTally { segments: tallies })
    }

    /// Compresses and codes a segment, whose transfer took `seconds` to compute.
    fn segment(&self, found: TransferSegment, seconds: f64) -> Result<(CodedSegment, SegmentTally), StudyError> {
        let TransferSegment { segment, vertices, signal } = found;
        let start = Instant::now();
        let compressed = CompressedSegment::new(segment, vertices, &signal, &self.options, |_| ())
            .map_err(|reason| of_segment(segment, &reason))?;
        let compressing = start.elapsed().as_secs_f64();
        let start = Instant::now();
        let coded = CodedSegment::code(&compressed, self.code)?;
        let coding = start.elapsed().as_secs_f64();
        let tally = SegmentTally {
            segment,
            vertices: coded.vertices.len(),
            clusters: coded.counts.len(),
            squares: signal.sum_of_squares(),
            squared_error: compressed.clustering.squared_error(&signal),
            coded_squared_error: coded.squared_errors(&signal).iter().sum(),
            seconds: [seconds, compressing, coding],
        };
        Ok((coded, tally))
    }
}

/// Error of options that conflict, or of principal components that cannot be found.
fn of_segment(segment: usize, reason: &CpcaError) -> StudyError {
    let help = "see `crossbar all-frequency compress --help`";
    StudyError::new("crossbar::prt::cpca", format!("segment {segment}: {reason}")).with_help(help)
}
