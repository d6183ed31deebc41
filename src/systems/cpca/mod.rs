//! System 4: precomputed radiance transfer, compressed by clustered principal components.
//!
//! - [`mod@reference`]: the paper by plain loops, without compression. Read it first.
//! - [`transfer`]: a matrix per vertex from light to exit radiance;
//! - [`coherence`]: clusters that are cheaper to draw;
//! - [`kernels`], [`on_card`]: compressed transfer drawn by vertex and pixel programs.
//!
//! The compression itself, which system 5 uses as well, is [`crate::transfer::clustering`], with a reference of
//! its own.

pub mod coherence;
pub mod kernels;
pub mod on_card;
pub mod reference;
pub mod transfer;
