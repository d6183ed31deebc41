//! System 4: precomputed radiance transfer, compressed by clustered principal components.
//!
//! - [`transfer`]: a matrix per vertex from light to exit radiance; [`mod@reference`] by plain loops;
//! - [`coherence`]: clusters that are cheaper to draw;
//! - [`kernels`], [`on_card`]: compressed transfer drawn by vertex and pixel programs;
//! - [`baselines`]: the same without compression, to compare with.
//!
//! The compression itself, which system 5 uses as well, is [`crate::transfer::clustering`].

pub mod baselines;
pub mod coherence;
pub mod kernels;
pub mod on_card;
pub mod reference;
pub mod transfer;
