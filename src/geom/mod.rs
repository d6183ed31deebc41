//! Meshes, rays, the teapot, and what is true of them.
//!
//! - [`mesh`]: triangles with shared vertices, validated once, so that nothing behind it has to check an index again;
//! - [`adjacency`]: which triangles meet at each edge;
//! - [`teapot`]: the Utah teapot at any rate of tessellation;
//! - [`exact`]: which triangle a ray hits first, decided in exact arithmetic: the ground truth of the studies;
//! - [`classify`]: a renderer's answer held against that truth;
//! - [`aimed`]: rays aimed at shared edges and vertices, where inconsistent arithmetic leaks;
//! - [`vector`]: what glam's vectors lack; [`UnitFrame`]: coordinates in units of a body's size;
//! - [`random`]: a counter-based random number generator.

pub mod adjacency;
pub mod aimed;
pub mod classify;
mod crease;
pub mod exact;
pub mod mesh;
mod orient;
pub mod random;
pub mod ray;
pub mod teapot;
mod teapot_table;
mod unit_frame;
pub mod vector;

pub use adjacency::{Adjacency, Edge};
pub use exact::{ExactT, NearestHit, Sides};
pub use mesh::{Contact, Mesh, MeshError};
pub use ray::{Hit, Ray, RayError};
pub use unit_frame::UnitFrame;
