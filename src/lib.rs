//! Crossbar: global illumination on the first programmable graphics cards, emulated to the bit.
//!
//! The emulated cards are in [`refsim`]; the systems that ran on them, the studies and the program are here.

pub mod case;
pub mod cli;
pub mod geom;
pub mod io;
pub mod ray_engine;
pub mod report;
pub mod scene;
pub mod shader;
pub mod study;
