//! Rasterise, run, output: what happens to a tile around the steps of its program.
//!
//! - `raster`: coverage and interpolation; `shader`: triangles taken together; `tiles`: a draw's rounds and tiles;
//!   `decoded`: programs that are kept.
//! - `output`, `store`, `targets`: tests, texels, targets. `trace`: following one pixel.

mod decoded;
mod output;
mod raster;
mod shader;
mod store;
mod targets;
mod tiles;
mod trace;

pub(crate) use decoded::PixelPrograms;
pub use tiles::{BatchTiles, TileRound};
pub use trace::BatchTracer;
