//! What is looked at, and from where.

pub mod camera;

pub use camera::{Camera, CameraError};
