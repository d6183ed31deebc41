//! Errors and sizes of transfer after compression and coding.

use serde::{Deserialize, Serialize};

/// Error and size of a segment.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SegmentTally {
    /// The segment.
    pub segment: usize,
    /// Vertices at which it is not 0.
    pub vertices: usize,
    /// Their clusters.
    pub clusters: usize,
    /// The squares of its transfer.
    pub squares: f64,
    /// The squared error of its compression.
    pub squared_error: f64,
    /// The squared error after coding.
    pub coded_squared_error: f64,
    /// Time of transfer, compression and coding, in seconds.
    pub seconds: [f64; 3],
}

/// Errors and sizes of all segments.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CompressionTally {
    /// Segment by segment, without empty ones.
    pub segments: Vec<SegmentTally>,
}

impl CompressionTally {
    /// A figure summed over segments.
    pub fn sum(&self, of: impl Fn(&SegmentTally) -> f64) -> f64 {
        self.segments.iter().map(of).sum()
    }
}
