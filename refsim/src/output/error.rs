//! Errors of targets.

use crate::texture::{Region, TextureKind};

/// Why something can't be a target.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum OutputError {
    /// More targets than the emulator has.
    #[error("expected at most {most} colour targets, found {found}")]
    TooManyTargets {
        /// How many there can be.
        most: usize,
        /// How many there are.
        found: usize,
    },
    /// An image that is not a plane.
    #[error("expected a 2-D or rectangle image as colour target {index}, found a {kind} image")]
    TargetKind {
        /// Which target.
        index: usize,
        /// What it is.
        kind: TextureKind,
    },
    /// Targets of several sizes in one draw.
    #[error("expected all targets of a draw to cover {expected:?}, found one of {width}x{height} pixels")]
    TargetSize {
        /// The pixels that the draw walks.
        expected: Region,
        /// Width of the target at fault.
        width: u32,
        /// Height of the target at fault.
        height: u32,
    },
    /// A depth surface of no or too many pixels.
    #[error("expected a depth surface of 1 to 16384 pixels a side, found {width}x{height}")]
    DepthExtent {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
    },
    /// No depth format of that name.
    #[error("expected a depth format as `d16`, `d24`, `d32`, `d32f` or `d24f`, found `{name}`")]
    UnknownDepthFormat {
        /// What was given.
        name: String,
    },
}
