//! The methods to which Figure 1 compares the paper's method, with its visibility and reflectance:
//!
//! - [`FixedView`]: \[NRH03\], transfer with one row per vertex for a fixed view, and a light of few wavelets;
//! - [`HarmonicTransfer`]: \[SKS02, KSS02\], matrices of spherical harmonics, and a light of as many harmonics.
//!
//! Both compute in f64 without compression of transfer. With all coefficients of the light, [`FixedView`] also gives
//! the reference picture without factorisation and coding.

mod fixed_view;
mod harmonic;

pub use fixed_view::{BaselineSubject, FixedView};
pub use harmonic::HarmonicTransfer;
