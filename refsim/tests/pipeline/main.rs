//! What is fixed beside the programs: texture reads, rasteriser, and output.

mod output;
mod raster;
#[path = "../common/sampling.rs"]
mod sampling;
mod texture;
