//! Meshes, rays, the teapot, and exact ray-triangle intersection.
//!
//! - [`mesh`]: triangles with shared vertices, validated once, so that later code need not check indices;
//! - [`adjacency`]: edges and the triangles that share them;
//! - [`teapot`]: the Utah teapot at any rate of tessellation;
//! - [`exact`]: the first hit of a ray in exact arithmetic: the ground truth of the studies;
//! - [`polygon`]: polygons cut into triangles;
//! - [`classify`]: a renderer's hit compared with the exact hit;
//! - [`aimed`]: rays aimed at shared edges and vertices, where inconsistent arithmetic leaks;
//! - [`vector`]: conversions and normalisation that glam lacks; [`UnitFrame`]: coordinates in units of a body's size;
//! - [`random`]: a counter-based random number generator.

pub mod adjacency;
pub mod aimed;
pub mod classify;
mod crease;
pub mod exact;
pub mod mesh;
mod orient;
pub mod polygon;
pub mod random;
pub mod ray;
pub mod rounded;
pub mod teapot;
mod teapot_table;
mod unit_frame;
pub mod vector;

pub use adjacency::{Adjacency, Edge};
pub use exact::{ExactT, NearestHit, Sides};
pub use mesh::{Contact, Mesh};
pub use ray::{Hit, Ray};
pub use unit_frame::UnitFrame;
