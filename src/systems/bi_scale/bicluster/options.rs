//! Options of biclustering.

/// Options of Algorithm 1 that the paper leaves open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BiclusterOptions {
    /// Random seed for the non-zeros at which biclusters start.
    pub seed: u64,
    /// True if rows and columns may also be deleted again (section IV-C: operations are insertions and deletions).
    pub deletion: bool,
    /// Residuals of at most this magnitude are dropped, once per matrix element; 0 is lossless, and so is what is
    /// negative or not a number. The sum of the biclusters then differs from the matrix by at most this in each element
    /// (the paper's future work, section VII).
    pub drop: f64,
}

impl Default for BiclusterOptions {
    fn default() -> Self {
        Self { seed: 1, deletion: true, drop: 0.0 }
    }
}
