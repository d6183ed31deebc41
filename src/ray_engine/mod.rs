//! System 1: the Ray Engine. Ray-triangle intersection as a pixel program; the crossbar of rays and triangles.
//!
//! Rays lie in textures, a pixel each; every triangle is a screen-filling quad whose attributes carry it to all pixels;
//! the depth buffer keeps the nearest t and the colour buffer its triangle. docs/papers/ray_engine.md maps each
//! equation.

mod answer;
mod barycentrics;
mod bits_left;
mod bundle;
mod card;
mod crossbar;
mod cull;
pub mod engine;
mod kernel;
pub mod kernels;
pub mod model;
mod outputs;
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
pub use crossbar::{Crossbar, MakeWatcher};
pub use kernel::{Form, Kernel};
pub use outputs::Outputs;
pub use rays::{RayBatch, RayBatchError};
pub use resident::ResidentCrossbar;
pub use vertex_crossbar::VertexCrossbar;
