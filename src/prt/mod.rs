//! System 4: precomputed radiance transfer, compressed by clustered principal components.
//!
//! System 5 is [`all_frequency`], system 6 [`bi_scale`].
//!
//! - [`brdf`]: reflectance functions, and their matrices of harmonics;
//! - [`transfer`]: what each vertex makes of distant light; [`mod@reference`] by plain loops;
//! - [`Signal`]: points of n numbers each, such as a transfer matrix per vertex;
//! - [`cpca`]: clustered principal components of any signal;
//! - [`coherence`]: clusters that are cheaper to draw;
//! - [`kernels`], [`on_card`]: compressed transfer drawn by vertex and pixel programs;
//! - [`rivals`]: the same without compression, to compare with;
//! - [`mod@file`]: the `.prt` file, with transfer and clusters; [`load_signal`] reads a signal from it, NPY or CSV;
//! - [`synthetic`]: signals made by a formula, for tests and measurements.

pub mod all_frequency;
pub mod bi_scale;
pub mod brdf;
pub mod coherence;
pub mod cpca;
pub mod file;
pub mod kernels;
mod load;
pub mod on_card;
pub mod reference;
pub mod rivals;
pub mod signal;
pub mod synthetic;
pub mod transfer;

pub use load::{SignalFileError, load_signal, load_signal_and_meaning};
pub use signal::{Signal, SignalError};
