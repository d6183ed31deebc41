//! Errors of render targets.

use crate::texture::{Region, TextureKind};

/// Error of setting up render targets.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages explain the fields")]
pub enum OutputError {
    /// More targets than the emulator supports.
    #[error("expected at most {most} colour targets, found {found}")]
    TooManyTargets { most: usize, found: usize },
    /// An image that is not two-dimensional.
    #[error("expected a 2-D or rectangle image as colour target {index}, found a {kind} image")]
    TargetKind { index: usize, kind: TextureKind },
    /// Targets of different sizes in one draw.
    #[error("expected all targets of a draw to cover {expected:?}, found one of {width}x{height} pixels")]
    TargetSize { expected: Region, width: u32, height: u32 },
    /// A depth surface of invalid size.
    #[error("expected a depth surface of 1 to 16384 pixels per side, found {width}x{height}")]
    DepthExtent { width: u32, height: u32 },
    /// There is no depth format with that name.
    #[error("expected a depth format such as `d16`, `d24`, `d32`, `d32f` or `d24f`, found `{name}`")]
    UnknownDepthFormat { name: String },
}
