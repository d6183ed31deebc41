//! System 4: precomputed radiance transfer, compressed by clustered principal components.

pub mod brdf;
pub mod reference;
pub mod transfer;
