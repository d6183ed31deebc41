//! Texture reads of the WGSL library compared with `refsim::texture`, bit for bit: every texel format, kind of texture,
//! filter, address mode and level of detail, with coordinates at and beyond every edge.

#[path = "common/adapter.rs"]
mod adapter;
#[path = "common/sampling.rs"]
mod sampling;
#[path = "common/random.rs"]
mod stream;

mod wgsl_texture {
    pub(crate) mod cases;
    #[cfg(feature = "wgpu")]
    pub(crate) mod device;
    pub(crate) mod module;
    pub(crate) mod random;
    pub(crate) mod reference;
    pub(crate) mod valid;
}

use wgsl_texture::*;

fn main() -> std::process::ExitCode {
    let mut trials = adapter::trials![on_host: valid::modules_are_valid];
    #[cfg(feature = "wgpu")]
    trials.extend(adapter::trials![
        on_adapter: device::reads_are_those_of_the_texture_room, device::texels_decode_as_the_texture_room_has_it
    ]);
    adapter::run(trials)
}
