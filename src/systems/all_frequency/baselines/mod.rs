//! The methods that Figure 1 of the paper compares with, on the same visibility and the same reflectance:
//!
//! - [`FixedView`]: \[NRH03\], transfer of one row per vertex for a view that is fixed, and a light of few wavelets;
//! - [`HarmonicTransfer`]: \[SKS02, KSS02\], matrices of spherical harmonics, and a light of as few.
//!
//! Both are in f64 and without compression of transfer. With all coefficients of the light [`FixedView`] is also the
//! picture that no factor and no code has touched.

mod fixed_view;
mod harmonic;

pub use fixed_view::{BaselineSubject, FixedView};
pub use harmonic::HarmonicTransfer;
