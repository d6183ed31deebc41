//! Errors of targets.

use crate::texture::{Region, TextureKind};

/// Why something can't be a target.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum OutputError {
    /// More targets than the emulator has.
    #[error("expected at most {most} colour targets, found {found}")]
    TooManyTargets { most: usize, found: usize },
    /// An image that is not a plane.
    #[error("expected a 2-D or rectangle image as colour target {index}, found a {kind} image")]
    TargetKind { index: usize, kind: TextureKind },
    /// Targets of several sizes in one draw.
    #[error("expected all targets of a draw to cover {expected:?}, found one of {width}x{height} pixels")]
    TargetSize { expected: Region, width: u32, height: u32 },
    /// A depth surface of no or too many pixels.
    #[error("expected a depth surface of 1 to 16384 pixels a side, found {width}x{height}")]
    DepthExtent { width: u32, height: u32 },
    /// No depth format of that name.
    #[error("expected a depth format as `d16`, `d24`, `d32`, `d32f` or `d24f`, found `{name}`")]
    UnknownDepthFormat { name: String },
}
