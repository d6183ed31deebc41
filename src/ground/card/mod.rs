//! General-purpose computing on an emulated card, as seen from the host: the common base of all systems.
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
pub use texels::{Texels, new_target, new_texture, signed_format};
