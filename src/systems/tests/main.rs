//! Tests of the modules' public interfaces, with a file or folder per module, in one binary.

mod all_frequency;
mod bi_scale;
mod byte_rays;
mod clustering;
mod cpca;
mod radiosity;
mod ray_engine;
mod renderer;
mod shared_edges;
mod subsurface;
mod transfer;

// Tests name modules as the library does, `crate::geom`.
use crossbar_base::{error, geom};
use crossbar_ground::{card, io, linalg, scene, sphere, tracer};

fn device(name: &str) -> refsim::device::Profile {
    refsim::device::Profile::named(name).expect("a device")
}
