//! Errors and sizes of transfer after compression and coding.

use serde::{Deserialize, Serialize};

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

/// Errors and sizes of all segments.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CompressionTally {
    /// Segment by segment, without empty ones.
    pub segments: Vec<SegmentTally>,
}

impl CompressionTally {
    /// Sums a figure over segments.
    pub fn sum(&self, of: impl Fn(&SegmentTally) -> f64) -> f64 {
        self.segments.iter().map(of).sum()
    }
}
