//! The paper's host: Gauss-Seidel on an Athlon, limited by its memory as the text says.
//!
//! An element costs an addition that waits for the one before, and, where the matrix does not fit the cache, its share of a cache
//! line from memory. A matrix is read from end to end again and again, so of one that is W bytes long a cache of C bytes still
//! holds C / W when it is asked again, at best.

use super::{PATCHES, PRINTED_HOST};

/// Clock: Athlon XP 2800+ with Barton core, as reviewed (Tom's Hardware).
const CLOCK_HZ: f64 = 2.083e9;
/// Its second-level cache (Tom's Hardware).
const CACHE_BYTES: f64 = 524_288.0;
/// Clocks from one addition to the next that needs its result. A guess: the latency usually given for this family.
const ADD_CLOCKS: f64 = 4.0;
/// Bytes of an element: single precision, as on the card. A guess.
const ELEMENT_BYTES: f64 = 4.0;

/// The share of a matrix that is not in the cache any more when it is asked for again.
fn missed(patches: f64) -> f64 {
    (1.0 - CACHE_BYTES / (ELEMENT_BYTES * patches * patches)).max(0.0)
}

/// Seconds an element from the cache.
fn cached() -> f64 {
    ADD_CLOCKS / CLOCK_HZ
}

/// Seconds an element from memory beside that: what is left of the printed rate, the one printed figure of the host.
fn from_memory() -> f64 {
    let n = f64::from(PATCHES);
    (1.0 / (PRINTED_HOST.0 * n * n) - cached()) / missed(n)
}

/// Seconds of a Gauss-Seidel iteration over so many patches.
pub(super) fn iteration(patches: u32) -> f64 {
    let n = f64::from(patches);
    n * n * (cached() + from_memory() * missed(n))
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    #[test]
    fn the_printed_rate_comes_back() {
        assert_abs_diff_eq!(1.0 / iteration(PATCHES), PRINTED_HOST.0, epsilon = 1e-9);
        // 362 x 362 elements are the cache.
        assert_eq!((missed(362.0), missed(64.0)), (0.0, 0.0));
        assert!(missed(363.0) > 0.0);
    }
}
