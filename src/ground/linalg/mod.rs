//! Dense linear algebra in f64, with the same bits for every processor, number of threads and set of cargo features.
//!
//! - [`Matrix`]: a dense matrix by rows, and its products; [`dot`]: the inner product;
//! - [`Lu`], blocked and parallel; [`SymmetricEigen`], by nalgebra;
//! - [`LeadingEigen`], [`LeadingSvd`]: all eigenvalues or singular values, but only the vectors of the largest.
//!
//! Products do not use nalgebra, because with its `std` feature it chooses its kernel, and so the order of sums, by the
//! processor.

mod bidiagonal;
mod dot;
mod factor;
mod leading;
mod leading_svd;
mod lu;
mod matrix;
mod reflection;
mod tridiagonal;

pub use dot::dot;
pub use factor::SymmetricEigen;
pub use leading::{LeadingEigen, make_largest_positive};
pub use leading_svd::LeadingSvd;
pub use lu::Lu;
pub use matrix::{MAX_ELEMENTS, MAX_SQUARE, Matrix};
