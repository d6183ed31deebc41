//! System 4: precomputed radiance transfer, compressed by clustered principal components.
//!
//! - [`paper`]: section 3.1 by plain loops, without compression; read it first;
//! - [`transfer`]: section 3, a matrix per vertex from light to exit radiance;
//! - [`crate::clustering`]: section 4, the compression, with its own `paper.rs`;
//! - [`coherence`]: section 5, clusters that are cheaper to draw;
//! - [`kernels`], [`on_card`]: section 6, compressed transfer drawn by vertex and pixel programs.

pub mod coherence;
pub mod kernels;
pub mod on_card;
pub mod paper;
pub mod transfer;
