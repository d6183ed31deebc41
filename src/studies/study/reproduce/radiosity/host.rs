//! The paper's host: Gauss-Seidel on an Athlon, limited by memory bandwidth, as the text says.
//!
//! An element costs an addition that waits for the previous addition and, if the matrix does not fit into the cache, a
//! share of a cache line from memory. The matrix is read sequentially in every iteration. At the next read, a cache of
//! C bytes still holds at most a fraction C / W of a matrix of W bytes.

use super::{PATCHES, PrintedRates, StudyError};

/// Clock in Hz: Athlon XP 2800+ with Barton core, as reviewed (Tom's Hardware).
const CLOCK_HZ: f64 = 2.083e9;
/// Size of its second-level cache in bytes (Tom's Hardware).
const CACHE_BYTES: f64 = 524_288.0;
/// Latency of an addition in clocks. A guess: the latency usually given for this family.
const ADD_CLOCKS: f64 = 4.0;
/// Bytes per element: single precision, as on the card. A guess.
const ELEMENT_BYTES: f64 = 4.0;

/// Fraction of a matrix that is no longer in the cache when it is read again.
fn missed(patches: f64) -> f64 {
    (1.0 - CACHE_BYTES / (ELEMENT_BYTES * patches * patches)).max(0.0)
}

/// Seconds per element from the cache.
fn cached() -> f64 {
    ADD_CLOCKS / CLOCK_HZ
}

/// Additional seconds per element from memory: the remainder of the printed rate, the only printed value used for the
/// host.
fn from_memory() -> Result<f64, StudyError> {
    let n = f64::from(PATCHES);
    let [_, host] = PrintedRates::both()?;
    Ok((1.0 / (host.per_s * n * n) - cached()) / missed(n))
}

/// Seconds of a Gauss-Seidel iteration over `patches` patches.
pub(super) fn iteration(patches: u32) -> Result<f64, StudyError> {
    let n = f64::from(patches);
    Ok(n * n * (cached() + from_memory()? * missed(n)))
}
