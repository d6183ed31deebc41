//! A sparse matrix as a sum of constant-column biclusters (sections IV-B, IV-C).
//!
//! - [`Bicluster`], [`Biclustering`]: rows, columns, and a value for each column (equations 4 to 8);
//! - [`bicluster`]: the decisions of [Algorithm 1](super::paper::biclusters) by influence values in queues (section V, Precomputation Optimization), on
//!   integers that are equal where numbers are: multiples of the matrix's unit, else numbers by their first appearance.
//!
//! Choices that the paper leaves open, the same for both:
//! - The remaining non-zeros are numbered row by row; the n-th bicluster starts at one chosen uniformly by a seeded
//!   random number.
//! - The operation with the largest gain is applied. Gains of rows are odd numbers, those of columns even ones; among
//!   equal gains the line with the lowest number wins.
//! - The value of a column is chosen when it is inserted, and kept: the most frequent value other than 0 in the rows,
//!   the lowest among equally frequent ones.
//! - The last row and the last column are not deleted.

mod draw;
mod lines;
mod numbers;
mod queue;
mod search;
mod sums;
mod whole;

pub(super) use draw::start;
pub use search::bicluster;
pub use sums::BiclusterResidual;
pub use whole::{Bicluster, BiclusterOptions, Biclustering};
