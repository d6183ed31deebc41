//! System 1: the Ray Engine. Ray-triangle intersection by a pixel program: every ray is tested against every triangle,
//! as in a crossbar.
//!
//! Rays are stored in textures, one per texel. Every triangle is drawn as a screen-filling quad whose attributes pass
//! it to all pixels. The depth buffer keeps the nearest t, and the color buffer the triangle's id.
//!
//! - [`paper`]: equations (1) to (8) in plain f64; read it first;
//! - 3.3, 4.2, 5.3: [`Crossbar`], every ray against every triangle, in buckets (`crossbar`, `bundle`, `card`);
//!   [`ResidentCrossbar`] draws again without uploads; 3.4: [`intersect_in_vertices`], in the vertex units;
//! - 4.1, 4.3: [`kernels`] and their choice ([`Kernel`]), including kernels without leaks at edges
//!   ([`EdgeRule`]); [`RayBatch`], rays as texels; scaling of scenes to a format's range (`range`, `reach`, `units`), and
//!   lost triangle normals ([`BitsLeft`]);
//! - 5.2, 5.3, 6.2, 6.3: [`engine`], with the 5-D [`ray_tree`], passes (`pass`) and culling in the vertex program
//!   (`cull`);
//! - 6.1: [`model`], equation (11).
//!
//! docs/papers/ray_engine.md says which file has which section.

mod answer;
mod bits_left;
mod bundle;
mod card;
mod crossbar;
mod cull;
pub mod engine;
mod kernel;
pub mod kernels;
pub mod model;
pub mod paper;
mod pass;
mod range;
pub mod ray_tree;
mod rays;
mod reach;
mod units;
mod vertex_crossbar;

pub use answer::{Answer, EngineError};
pub use bits_left::BitsLeft;
pub use crossbar::{Crossbar, Recording, ResidentCrossbar};
pub use kernel::{EdgeRule, Form, Kernel, RayTexels};
pub use rays::RayBatch;
pub use vertex_crossbar::intersect_in_vertices;
