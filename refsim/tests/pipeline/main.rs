//! Stages without programs: texture reads, rasteriser, and output.

mod output;
#[path = "../common/random.rs"]
mod random;
mod raster;
#[path = "../common/sampling.rs"]
mod sampling;
mod texture;
