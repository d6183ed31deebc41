//! Other ways to store transfer, which the paper compares biclusters with or rejects (sections II, IV-A and VI-B):
//!
//! - [`CompressedRows`]: rows of columns and values, three or eight bytes an entry; nothing is lost;
//! - [`RowClusters`]: clustered principal components of rows (Figure 6, c);
//! - [`HaarRows`]: a few wavelet coefficients of each row (Figure 6, d);
//! - [`HarmonicRows`]: transfer of spherical harmonics, on one side or on both (Figures 1 and 5);
//! - [`ReshuffledVisibility`]: visibility of few texels and a shuffle of them in place of a rotation (section IV-A);
//! - [`StoredTransfer`]: what they share with biclusters: sizes, and light times them; [`LocalLightError`]: how far the
//!   light that arrives is off;
//! - [`mod@reference`]: wavelets and clusters by plain loops.
//!
//! Products are taken in f64 of numbers as they are stored, so that an error is that of what is stored.

mod biclusters;
mod clusters;
mod compressed_rows;
mod error;
mod haar_rows;
mod harmonic_rows;
mod local_transfer;
pub mod reference;
mod refine;
mod reshuffled;
mod stored;

pub use clusters::{RowClusterOptions, RowClusters};
pub use compressed_rows::{CompressedRows, NarrowRows, RowColumn, RowValue, WideRows};
pub use error::RivalError;
pub use haar_rows::{CoefficientPriority, CoefficientStorage, HaarRowOptions, HaarRows};
pub use harmonic_rows::{HarmonicRows, HarmonicSides};
pub use local_transfer::{LocalTransfer, cell_integrals};
pub use reshuffled::ReshuffledVisibility;
pub use stored::{LocalLightError, StoredSize, StoredTransfer};
