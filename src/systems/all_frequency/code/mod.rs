//! Coding of compressed transfer (section 4 of the paper): weights and representatives as integers of a few bits, and
//! of the representatives, which are mostly 0 in the Haar basis, those numbers alone that are not.
//!
//! - [`CodedTransfer`]: all of it, with its size in bytes;
//! - [`SparseRows`]: rows of integers in blocks of 256, column by column, a row number and a value for each number that
//!   is not 0;
//! - [`CodeOptions`]: bits, and what shares a scale, of which the paper says nothing.

mod coarser;
mod coded;
mod decoded;
mod quantise;
mod sparse;

pub use coded::{CodeSize, CodedSegment, CodedTransfer};
pub use quantise::{CodeOptions, CodeOptionsError, ScaleOf};
pub(super) use sparse::SparseColumn;
pub use sparse::{BLOCK_ROWS, SparseRows};
