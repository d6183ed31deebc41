//! Meshes, rays, the teapot, and exact ray-triangle intersection.

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
