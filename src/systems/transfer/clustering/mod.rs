//! Clustered principal component analysis: points are assigned to clusters, each of which is approximated by an affine
//! subspace, a mean and a few orthonormal vectors (sections 3.3 and 4 of the paper), or by vectors alone
//! ([`CpcaForm::Linear`]).
//!
//! - [`mod@reference`]: the paper by plain loops, for tests. Read it first.
//! - [`compress`]: from a signal and [`CpcaOptions`] to a [`Clustering`]: vector quantisation, static, iterative,
//!   adaptive;
//! - [`mod@reference`]: the same by plain loops, for tests.
//!
//! Choices that the paper leaves open: ties go to the lower cluster; an empty cluster takes the point of largest error
//! from a cluster that has others; the component of largest magnitude of each vector is positive; loops end when no
//! point moves. Distances are compared as in f64. A point whose squared error is at most 2^-40 of its squared distance
//! from the mean lies in the subspace: its error is 0. Vectors whose eigenvalue is at most 2^-44 of the cluster's
//! largest are left out. Results have the same bits on every CPU and number of threads.

mod axes;
mod budget;
mod compress;
mod compressed;
mod fit;
mod gram;
mod members;
mod nearest;
mod options;
mod products;
pub mod reference;
mod subspace;

pub use compress::{Compression, CpcaStep, CpcaStepKind, compress};
pub use compressed::Clustering;
pub use options::{CpcaError, CpcaForm, CpcaMethod, CpcaOptions, StartPoints};
pub use subspace::AffineSubspace;
