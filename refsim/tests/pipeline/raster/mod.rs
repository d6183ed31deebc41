//! Tests of `refsim::raster`: the fill rule on random meshes, interpolation compared with host floats, clipping, and
//! robustness against arbitrary bit patterns.

mod assembly;
mod clipping;
mod coverage;
mod interpolation;
mod support;
mod window;
