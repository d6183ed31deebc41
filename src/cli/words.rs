//! Numbers in sentences.

use crate::report::digits::{Quantity, count, shown};

pub(super) fn counted(number: usize) -> String {
    count(number as u64)
}

/// A measured number, for a sentence: `39.57`, `0.0001235`.
pub(super) fn measured(number: f64) -> String {
    shown(number, Quantity::Measured)
}
