//! Texture reads of the GPU text against the texture room, bit for bit: every texel format, kind of texture, filter,
//! address mode and level of detail, with coordinates at and beyond every edge.

mod wgsl_texture {
    mod cases;
    #[cfg(feature = "wgpu")]
    #[expect(clippy::print_stdout, reason = "tests say what took how long, and that they saw no adapter")]
    mod device;
    mod module;
    mod random;
    mod reference;
    mod valid;
}
