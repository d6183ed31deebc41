//! Clustered principal component analysis (from the paper of system 4; systems 5 and 6 also use it). Points are
//! assigned to clusters. Each cluster is approximated by an affine subspace, a mean and a few orthonormal vectors
//! (sections 3.3 and 4 of the paper), or by vectors alone ([`CpcaForm::Linear`]).
//!
//! | section | file |
//! |---|---|
//! | all | [`paper`]: by plain loops, for tests; read it first |
//! | 3.3 | `signal.rs`: points of n numbers each; `compressed.rs`: subspaces, and the result, a [`Clustering`] |
//! | 4.1 | `options.rs`; `compress.rs`: LBG; `fit.rs`, `products.rs`: principal components |
//! | 4.2 | `nearest.rs`, `axes.rs`: the best cluster of each point |
//! | 4.3 | `compress.rs`: redistribution of vectors |
//!
//! The paper leaves open these choices: ties go to the lower cluster; an empty cluster gets the point with the largest
//! error from a cluster with other points; the component of largest magnitude of each vector is positive; loops end
//! when no point moves. Distances are compared as in f64. A point whose squared error is at most 2^-40 of its squared
//! distance from the mean lies in the subspace: its error is 0. Vectors whose eigenvalue is at most 2^-44 of the
//! cluster's largest are dropped. Results have the same bits on every CPU and number of threads.

mod axes;
mod compress;
mod compressed;
mod fit;
mod nearest;
mod options;
pub mod paper;
mod products;
mod signal;

pub use compress::{Compression, CpcaStep, CpcaStepKind, compress, compress_at};
pub use compressed::{AffineSubspace, Clustering};
pub use options::{CpcaForm, CpcaMethod, CpcaOptions};
pub use signal::Signal;
