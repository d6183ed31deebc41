//! Scenes and cameras.
//!
//! - [`built`]: models built by the project, by name;
//! - [`camera`]: pinhole cameras, whose rays have the same bits everywhere;
//! - [`material`]: scattering and emission of surfaces;
//! - [`model`]: triangles with materials, lights and views.

pub mod built;
pub mod camera;
pub mod material;
pub mod model;

pub use camera::Camera;
pub use material::{Color, Material, Surface};
pub use model::{PointLight, Scene, View};
