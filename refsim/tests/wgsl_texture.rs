//! Compares texture reads of the WGSL library with `refsim::texture`, bit for bit: every texel format, kind of texture,
//! filter, address mode and level of detail, with coordinates at and beyond every edge.

#[path = "common/adapter.rs"]
mod adapter;
#[path = "common/sampling.rs"]
mod sampling;
#[path = "common/random.rs"]
mod stream;

mod wgsl_texture {
    pub(crate) mod cases;
    pub(crate) mod device;
    pub(crate) mod module;
    pub(crate) mod random;
    pub(crate) mod reference;
}

#[path = "common/valid_wgsl.rs"]
mod valid_wgsl;

use wgsl_texture::*;

fn modules_are_valid() {
    for text in [module::reading(), module::decoding()] {
        valid_wgsl::valid(&text);
    }
}

fn main() -> std::process::ExitCode {
    let mut trials = adapter::trials![on_host: modules_are_valid];
    trials.extend(adapter::trials![
        on_adapter: device::reads_are_those_of_the_texture_room, device::texels_decode_as_the_texture_room_has_it
    ]);
    adapter::run(trials)
}
