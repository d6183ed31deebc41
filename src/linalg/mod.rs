//! Dense linear algebra in f64, with the same bits on every processor, number of threads and set of cargo features.
//!
//! - [`Matrix`]: a dense matrix by rows, and its products; [`dot`]: the inner product;
//! - [`Lu`], [`Qr`], [`SymmetricEigen`], [`Svd`]: factorisations, by nalgebra;
//! - [`LeadingEigen`]: the largest eigenvalues and their vectors alone.
//!
//! The order of sums in products is our own, since nalgebra's product chooses its kernel by the processor when its
//! `std` feature is on (docs/decisions/0016).

mod dot;
mod factor;
mod leading;
mod lu;
mod matrix;

pub use dot::dot;
pub use factor::{FactorError, Qr, Svd, SymmetricEigen};
pub use leading::{LeadingEigen, make_largest_positive};
pub use lu::{Lu, Singular};
pub use matrix::{MAX_ELEMENTS, MAX_SQUARE, Matrix, MatrixError};
