//! Proofs of the raster room: the fill rule as a law over random meshes, interpolation against host floats, clipping,
//! and that no bit pattern makes it panic.

mod raster {
    mod clipping;
    mod coverage;
    mod interpolation;
    mod support;
    mod window;
}
