//! Scenes and cameras.

pub mod built;
pub mod camera;
pub mod material;
pub mod model;

pub use camera::Camera;
pub use material::{Color, Material, Surface};
pub use model::{PointLight, Scene, View};
