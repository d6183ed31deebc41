//! Tests pipeline stages that run no program: texture reads, the rasterizer, and output.

mod output;
#[path = "../common/random.rs"]
mod random;
mod raster;
#[path = "../common/sampling.rs"]
mod sampling;
mod texture;
