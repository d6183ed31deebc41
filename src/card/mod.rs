//! The host's side of an emulated card that computes, for all systems.
//!
//! - [`KernelText`]: a program with the name of its file, assembled and checked against a device;
//! - [`Texels`]: rectangles of floats, to textures and back; [`new_target`]: an empty one to draw into;
//! - [`FullScreenPass`]: one quad over a target; [`PingPong`]: two targets that passes write in turn;
//! - [`Levels`]: a pyramid of targets, each filled from the one before;
//! - [`NearestTarget`]: a color target that keeps the nearest fragment; [`ViewTarget`] keeps one from view to view;
//! - [`Attribute`], [`vertex_streams`]: what vertices hold.
//!
//! Textures are rectangles, which is how the cards of 2003 had float textures: coordinates count texels, and the
//! center of texel i is at i + 0.5.

mod attributes;
mod kernel;
mod levels;
mod nearest;
mod pass;
mod texels;

pub use attributes::{Attribute, attribute, through_half, vertex_streams};
pub use kernel::{KernelError, KernelText};
pub(crate) use kernel::{checked, instructions, kernels};
pub use levels::Levels;
pub use nearest::{NearestTarget, ViewTarget};
pub use pass::{BILINEAR, FullScreenPass, PingPong, ReadTexture, constants, nearest};
pub use refsim::raster::full_screen_quad;
pub use texels::{Texels, new_target};
