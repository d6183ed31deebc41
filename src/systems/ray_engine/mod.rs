//! System 1: the Ray Engine. Ray-triangle intersection as a pixel program; the crossbar of rays and triangles.
//!
//! Rays are stored in textures, one per texel; every triangle is drawn as a screen-filling quad whose attributes pass
//! it to all pixels; the depth buffer keeps the nearest t and the color buffer the triangle's id.
//! docs/papers/ray_engine.md maps each equation.

mod answer;
mod bits_left;
mod bundle;
mod card;
mod crossbar;
mod cull;
pub mod engine;
mod id_color;
mod kernel;
pub mod kernels;
pub mod model;
mod pass;
mod range;
pub mod ray_tree;
mod rays;
mod reach;
pub mod reference;
mod resident;
mod units;
mod vertex_crossbar;

pub use answer::{Answer, EngineError};
pub use bits_left::BitsLeft;
pub use crossbar::{Crossbar, MakeObserver};
pub use kernel::{Form, Kernel};
pub use rays::RayBatch;
pub use resident::ResidentCrossbar;
pub use vertex_crossbar::VertexCrossbar;
