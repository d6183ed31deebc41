//! A sparse matrix as a sum of constant-column biclusters (sections IV-B, IV-C).
//!
//! - [`Bicluster`], [`Biclustering`]: rows, columns, and a value for each column (equations 4 to 8);
//! - [`mod@reference`]: Algorithm 1 on a dense matrix, every operation tried by equation 9;
//! - [`bicluster`]: the same decisions by influence values in queues (section V, Precomputation Optimization).
//!
//! What the paper leaves open is settled so, for both:
//! - The non-zeros of what is left are numbered row by row; the n-th bicluster starts at the one that a seeded random
//!   number picks, all alike.
//! - The operation that gains most is done. Insertions and deletions of rows gain odd numbers, those of columns even
//!   ones; of equal gains the line of the lowest number is taken.
//! - The value of a column is chosen when it is inserted, and kept: the most frequent value other than 0 in the rows,
//!   of equally frequent ones the lowest.
//! - The last row and the last column are not deleted.

mod draw;
mod lines;
mod options;
mod queue;
pub mod reference;
mod search;
mod tally;
mod whole;

pub use options::{BiclusterError, BiclusterOptions};
pub use search::bicluster;
pub use whole::{Bicluster, Biclustering};
