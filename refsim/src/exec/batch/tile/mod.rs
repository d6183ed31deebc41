//! Rasterise, run, output: what happens to a tile around the steps of its program.
//!
//! - `raster`: coverage and interpolation; `shader`: triangles taken together; `round`: what is constant over each
//!   triangle; `tiles`: a draw's tiles; `pieces`: a tile shared among threads; `decoded`: programs that are kept.
//! - `output`, `store`, `targets`: tests, texels, targets. `trace`: following one pixel.

mod decoded;
mod output;
mod pieces;
mod raster;
mod round;
mod shader;
mod store;
mod targets;
mod tiles;
mod trace;

pub(crate) use decoded::PixelPrograms;
pub use round::TileRound;
pub use tiles::BatchTiles;
pub use trace::BatchTracer;
