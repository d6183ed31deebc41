//! What comes out of transfer.

use thiserror::Error;

/// Transferred radiance T_p: per vertex m rows of 3 channels.
#[derive(Clone, Debug, PartialEq)]
pub struct TransferredRadiance {
    pub(super) rows: usize,
    /// Numbers per vertex: 3 m, and zeros.
    pub(super) stride: usize,
    pub(super) values: Vec<f32>,
}

impl TransferredRadiance {
    /// From numbers: per vertex its rows of 3 channels.
    ///
    /// # Panics
    /// If there are no rows, or not whole vertices.
    pub fn new(rows: usize, values: Vec<[f32; 3]>) -> Self {
        assert!(rows > 0 && values.len().is_multiple_of(rows), "{} numbers are no rows of {rows}", values.len());
        Self { rows, stride: 3 * rows, values: values.into_flattened() }
    }

    /// The rows m.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// A vertex's rows, 3 channels each.
    ///
    /// # Panics
    /// If there is no such vertex.
    pub fn of(&self, vertex: usize) -> &[[f32; 3]] {
        self.values[vertex * self.stride..][..3 * self.rows].as_chunks().0
    }

    /// Number of vertices.
    pub fn vertices(&self) -> usize {
        self.values.len() / self.stride
    }
}

/// Multiplications of numbers that are not skipped, all channels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Multiplies {
    /// By the light coefficients, step 2 of section 6.
    pub per_cluster: u64,
    /// By the weights, step 3.
    pub per_vertex: u64,
}

/// Light of another size than transfer needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("expected at least {expected} light coefficients, {per_segment} per segment, found {found}")]
pub struct LightSizeError {
    /// Coefficients up to the last segment.
    pub expected: usize,
    /// Coefficients of a segment.
    pub per_segment: usize,
    /// Those given.
    pub found: usize,
}

impl LightSizeError {
    /// Refuses too few coefficients for segments up to `last`.
    pub(super) fn check(found: usize, per_segment: usize, last: Option<usize>) -> Result<(), Self> {
        let expected = last.map_or(0, |last| (last + 1) * per_segment);
        if found < expected { Err(Self { expected, per_segment, found }) } else { Ok(()) }
    }
}
