//! Transfer computed, compressed and coded, one segment of the light at a time.

use std::time::Instant;

use serde::{Deserialize, Serialize};

use crate::all_frequency::Reflectance;
use crate::all_frequency::code::{CodeOptions, CodedSegment, CodedTransfer};
use crate::all_frequency::compressed::{CompressedSegment, SegmentOptions};
use crate::all_frequency::transfer::{TransferSegment, transfer_of};
use crate::error::InputError;
use crate::kept::KeptResults;
use crate::study::{ProgressFn, StudyError};
use crate::transfer::Vertices;
use crate::transfer::grid::Segmentation;
use crate::transfer::linear_basis::{BasisWidth, LinearBasis};
use crate::transfer::visibility::VisibilityMaps;

/// Transfer to be compressed, and options.
#[derive(Debug)]
pub struct SegmentedCompression<'a> {
    /// The vertices of the model.
    pub vertices: &'a Vertices,
    /// Visibility at each vertex.
    pub maps: &'a VisibilityMaps,
    /// Hat functions of the light's texels.
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

/// Error and size of a segment.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SegmentTally {
    /// Index of the segment.
    pub segment: usize,
    /// Number of vertices at which the segment is not 0.
    pub vertices: usize,
    /// Number of clusters of these vertices.
    pub clusters: usize,
    /// Sum of squares of the segment's transfer.
    pub squares: f64,
    /// Squared error of compression.
    pub squared_error: f64,
    /// Squared error after coding.
    pub coded_squared_error: f64,
    /// Time of transfer, compression and coding, in seconds.
    pub seconds: [f64; 3],
}

impl SegmentedCompression<'_> {
    /// Bytes of raw transfer in single precision, of all 24 segments at all vertices.
    pub fn raw_bytes(&self) -> u64 {
        let numbers = self.reflectance.terms() * Segmentation::Quarters.len() * Segmentation::Quarters.count();
        4 * self.vertices.len() as u64 * numbers as u64
    }

    /// Compresses and codes all segments; empty ones are left out. Fails if transfer cannot be computed, compressed or
    /// coded, or finished segments cannot be stored or read back.
    pub fn run(&self, progress: &mut ProgressFn<'_>) -> Result<(CodedTransfer, Vec<SegmentTally>), StudyError> {
        let hats = LinearBasis::new(self.hats);
        let transfer = transfer_of(self.vertices, self.maps, &hats, self.reflectance);
        let count = Segmentation::Quarters.count();
        let finished = |segment: usize| {
            progress("segments", segment as u64, count as u64);
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
        let found = (0..count).map(finished).collect::<Result<Vec<_>, StudyError>>()?;
        let (segments, tallies) = found.into_iter().flatten().unzip();
        let (rows, coefficients) = (self.reflectance.terms(), Segmentation::Quarters.len());
        let coded = CodedTransfer { rows, coefficients, vertices: self.vertices.len(), options: self.code, segments };
        Ok((coded, tallies))
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
fn of_segment(segment: usize, reason: &InputError) -> StudyError {
    let help = "see `crossbar all-frequency compress --help`";
    StudyError::new("crossbar::prt::cpca", format!("segment {segment}: {reason}")).with_help(help)
}
