//! What is looked at, and from where.
//!
//! - [`built`]: the scenes that the project builds itself, by name;
//! - [`camera`]: pinhole cameras, whose rays are the same bits everywhere;
//! - [`material`]: what surfaces do with light;
//! - [`whole`]: triangles with materials, lights and views.

pub mod built;
pub mod camera;
pub mod material;
pub mod whole;

pub use camera::{Camera, CameraError};
pub use material::{Color, Material, Surface};
pub use whole::{PointLight, Scene, SceneError, View};
