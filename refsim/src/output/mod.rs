//! The output stage: kill, alpha test, depth test, blending, write masks, targets.
//!
//! Steps per fragment, in order: kill by the program; alpha test; depth clamped, quantised and tested; depth written;
//! each colour quantised, blended, masked and written. See docs/numbers.md, "Targets and depth".

mod blend;
mod depth;
mod error;
mod merge;
mod tile;

pub use blend::{BlendEquation, BlendFactor, BlendOp, BlendState, blend_texel};
pub use depth::{CompareFunction, DepthFormat, DepthState, DepthSurface};
pub use error::OutputError;
pub use merge::{AlphaTest, FragmentFate, FragmentOutput, OutputRules, OutputState, WriteMask, merge};
pub use tile::{ColorTile, DepthTile, TargetTile};

/// Maximum number of colour targets per draw.
pub const MAX_TARGETS: usize = 4;
