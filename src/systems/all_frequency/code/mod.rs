//! Coding of compressed transfer (section 4 of the paper): weights and representatives as integers of a few bits. Only
//! the non-zero numbers of representatives are stored, because most are 0 in the Haar basis.
//!
//! - [`CodedTransfer`]: coded transfer of a mesh, with its size in bytes;
//! - [`SparseRows`]: rows of integers in blocks of 256, column by column, with a row number and a value for each
//!   non-zero number;
//! - [`CodeOptions`]: bits, and the numbers that share a scale, which the paper leaves open.

mod coded;
mod decoded;
mod quantise;
mod sparse;

pub use coded::{CodeSize, CodedSegment, CodedTransfer};
pub use quantise::{CodeOptions, ScaleOf};
pub(super) use sparse::SparseColumn;
pub use sparse::{BLOCK_ROWS, SparseRows};
