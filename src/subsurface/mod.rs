//! System 3: light that scatters below a surface, gathered over a meshed atlas by fragment programs.
//!
//! docs/papers/subsurface.md maps each equation.

pub mod kernels;
pub mod on_card;
