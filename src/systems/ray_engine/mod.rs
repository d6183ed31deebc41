//! System 1: the Ray Engine. Ray-triangle intersection as a pixel program; the crossbar of rays and triangles.
//!
//! Rays are stored in textures, one per texel; every triangle is drawn as a screen-filling quad whose attributes pass
//! it to all pixels; the depth buffer keeps the nearest t and the color buffer the triangle's id.
//!
//! - [`paper`]: equations (1) to (8) in plain f64, to be read first;
//! - 3.3, 4.2, 5.3: [`Crossbar`], every ray against every triangle, in buckets (`crossbar`, `bundle`, `card`,
//!   `id_color`); [`ResidentCrossbar`] draws again without uploads; 3.4: [`VertexCrossbar`], the same in the vertex
//!   units;
//! - 4.1, 4.3: [`kernels`] and their choice ([`Kernel`]), and those that leak at no edge ([`EdgeRule`], `sorted`);
//!   [`RayBatch`], rays as texels; what brings scenes into a
//!   format's range (`range`, `reach`, `units`), and how much of a mesh it loses ([`BitsLeft`]);
//! - 5.2, 5.3, 6.2, 6.3: [`engine`], with the 5-D [`ray_tree`], passes (`pass`) and culling in the vertex program
//!   (`cull`);
//! - 6.1: [`model`], equation (11).
//!
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
pub mod paper;
mod pass;
mod range;
pub mod ray_tree;
mod rays;
mod reach;
mod resident;
mod sorted;
mod units;
mod vertex_crossbar;

pub use answer::{Answer, EngineError};
pub use bits_left::BitsLeft;
pub use crossbar::{Crossbar, MakeObserver};
pub use kernel::{EdgeRule, Form, Kernel, RayTexels};
pub use rays::RayBatch;
pub use resident::ResidentCrossbar;
pub use vertex_crossbar::VertexCrossbar;
