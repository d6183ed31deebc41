//! A sparse matrix as a sum of constant-column biclusters (sections IV-B, IV-C).
//!
//! - [`Bicluster`], [`Biclustering`]: rows, columns, and a value for each column (equations 4 to 8);
//! - [`bicluster`]: makes the decisions of [Algorithm 1](super::paper::biclusters) by influence values in queues
//!   (section V, Precomputation Optimization), on integers: multiples of the matrix's unit.
//!
//! Both make these choices, which the paper leaves open:
//! - The remaining non-zeros are numbered row by row; the n-th bicluster starts at a non-zero chosen uniformly by a
//!   seeded random number.
//! - The operation with the largest gain is applied. Gains of rows are odd, and gains of columns are even; among equal
//!   gains the line with the lowest index is taken.
//! - The value of a column is chosen when it is inserted, and never changes: the most frequent non-zero value in the
//!   rows, and among equally frequent values the lowest.
//! - The last row and the last column are not deleted.

mod draw;
mod lines;
mod queue;
mod search;
mod whole;

pub use draw::SEED;
pub(super) use draw::start;
pub use search::bicluster;
pub use whole::{Bicluster, Biclustering};
