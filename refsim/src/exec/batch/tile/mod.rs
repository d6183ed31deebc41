//! Rasterise, run, output: what happens to a tile around the steps of its program.
//!
//! - `raster`: coverage and interpolation; `shader`: triangles taken together; `packed`, `packed_rows`: small
//!   triangles in one batch; `round`: what is constant over each triangle; `shading`: a thread's work on a tile;
//!   `tiles`: a draw's tiles; `pieces`: a tile shared among threads; `decoded`: programs that are kept.
//! - `output`, `early`, `store`, `blend`, `targets`: tests, texels, targets. `trace`: following one pixel.

mod blend;
mod decoded;
mod early;
mod output;
mod packed;
mod packed_rows;
mod pieces;
mod raster;
mod round;
mod shader;
mod shading;
mod store;
mod targets;
mod tiles;
mod trace;

pub(crate) use decoded::PixelPrograms;
pub use round::TileRound;
pub use tiles::BatchTiles;
pub use trace::BatchTracer;
