//! System 6: all-frequency bi-scale radiance transfer by biclustering.
//!
//! - [`paper`]: Algorithms 1 and 2 and equation 3 by plain loops; read it first;
//! - [`directions`]: the local directions to which light is transferred (section VI-A);
//! - [`transfer`]: the macro-scale transfer T of a mesh's vertices (section IV-A), a sparse [`matrix`];
//! - [`mod@file`]: files of transfer and biclusters (`.npz`);
//! - [`bicluster`]: T as a sum of constant-column biclusters (sections IV-B and IV-C, Algorithm 1);
//! - [`product`]: light times the sum of biclusters (section V, Algorithm 2);
//! - [`low_frequency`]: light in harmonics instead of texels (Figures 1 and 5);
//! - [`on_card`]: products and pictures on an emulated card; [`kernels`]: its programs (section V, Rendering);
//! - [`texture`]: the bidirectional textures that local light illuminates (section III);
//! - [`shade`]: pixels, the product of texture and local light (section III, equation 3).

pub mod bicluster;
pub mod directions;
pub mod file;
pub mod kernels;
pub mod low_frequency;
pub mod matrix;
pub mod on_card;
pub mod paper;
pub mod product;
pub mod shade;
pub mod texture;
pub mod transfer;
