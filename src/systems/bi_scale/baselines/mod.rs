//! Baselines: other ways to store transfer, which the paper compares with biclusters or rejects (sections II, IV-A,
//! VI-B):
//!
//! - [`CompressedRows`]: rows as columns and values, three or eight bytes per entry; lossless;
//! - [`RowClusters`]: clustered principal components of rows (Figure 6, c);
//! - [`HaarRows`]: a few wavelet coefficients of each row (Figure 6, d);
//! - [`HarmonicRows`]: transfer of spherical harmonics, on one side or on both (Figures 1 and 5);
//! - [`ReshuffledVisibility`]: visibility of few texels, with a permutation of texels instead of a rotation (section
//!   IV-A);
//! - [`StoredTransfer`]: the common interface of baselines and biclusters: sizes, and products with light;
//!   [`LocalLightError`]: the error of local light.
//!
//! Products are computed in f64 from the stored numbers, so that only the storage causes errors.

mod clusters;
mod compressed_rows;
mod haar_rows;
mod harmonic_rows;
mod local_transfer;
mod refine;
mod reshuffled;
mod stored;

pub use clusters::{RowClusterOptions, RowClusters};
pub use compressed_rows::CompressedRows;
pub use haar_rows::{CoefficientPriority, CoefficientStorage, HaarRowOptions, HaarRows};
pub use harmonic_rows::{HarmonicRows, HarmonicSides};
pub use local_transfer::{LocalTransfer, cell_integrals};
pub use reshuffled::ReshuffledVisibility;
pub use stored::{LocalLightError, StoredSize, StoredTransfer, columns_error};
