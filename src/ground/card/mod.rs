//! General-purpose computing on an emulated card, as seen from the host: the common base of all systems.
//!
//! - [`KernelText`]: a program with the name of its file, assembled and checked against a device;
//! - [`Texels`]: rectangles of floats, to textures and back; [`new_target`]: an empty one to draw into;
//! - [`FullScreenPass`]: one quad over a target; [`PingPong`]: two targets that passes write in turn;
//! - [`Levels`]: a pyramid of targets, each filled from the one before;
//! - [`NearestTarget`]: a color target that keeps the nearest fragment;
//! - [`Attribute`], [`by_register`], [`vertex_streams`]: data per vertex;
//! - [`MeshDisplay`]: a card that draws a mesh from a camera; [`seen_pixels`]: the triangle at each pixel of a device's
//!   raster, which [`RasterizedEyes`] uses in place of eye rays;
//! - [`frame_time`](mod@frame_time): modelled time of a frame, host work included;
//! - [`CardError`]: the reason why a card cannot compute or draw.
//!
//! Textures are rectangles, which is how the cards of 2003 had float textures: coordinates count texels, and the
//! center of texel i is at i + 0.5.

mod attributes;
mod display;
mod error;
pub mod frame_time;
mod kernel;
pub mod kernels;
mod levels;
mod nearest;
mod pass;
mod seen;
mod texels;

pub use attributes::{Attribute, attribute, by_register, check_finite, through_half, vertex_streams};
pub use display::{DepthPrograms, KeptFragments, MeshDisplay, MeshDraw, MeshPass, MeshView};
pub use error::CardError;
pub use kernel::{KernelError, KernelText, WrittenKernel, require_versions, vertex_version};
pub use kernel::{PARABOLIC, TO_CLIP, local_view, parabolic};
pub use kernel::{checked, instructions, kernels, slots};
pub use levels::Levels;
pub use nearest::NearestTarget;
use nearest::ViewTarget;
pub use pass::{BILINEAR, FullScreenPass, PingPong, ReadTexture, constants, nearest};
pub use refsim::raster::full_screen_quad;
pub use seen::{RasterizedEyes, SeenPixel, seen_pixels};
pub use texels::{Texels, new_target, new_texture};
