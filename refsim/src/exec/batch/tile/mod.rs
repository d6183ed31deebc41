//! Rasterisation, shading and output of a tile.
//!
//! - `raster`: coverage and interpolation; `shader`: grouping of triangles; `packed`, `packed_rows`: packing of small
//!   triangles; `round`: per-triangle constants; `shading`: a thread's work on a tile; `tiles`: the tiles of a draw;
//!   `pieces`: division of a tile among threads; `decoded`: cache of programs.
//! - `output`, `early`, `store`, `blend`, `targets`: tests, texels, targets.

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

pub(crate) use decoded::PixelPrograms;
pub use round::TileRound;
pub use tiles::BatchTiles;
