//! Errors of cutting a scene into patches.

use thiserror::Error;

use crate::linalg::MAX_SQUARE;

/// Maximum number of patches: the rows of the largest matrix.
pub const MAX_PATCHES: usize = MAX_SQUARE;

/// Error of cutting a scene into patches.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Error)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum PatchError {
    /// The scene has no triangles.
    #[error("expected a scene with surfaces, found none")]
    Empty,
    /// A triangle is so thin that its area is a rounding error.
    #[error("triangle {triangle} (counted from 0) is too thin for a patch; remove it, or merge its corners")]
    TooThin { triangle: u32 },
    /// There are more patches than the largest matrix has rows.
    #[error("expected at most {MAX_PATCHES} patches, found {found}; cut the faces into fewer")]
    TooMany { found: usize },
    /// The number of parts per side is 0.
    #[error("expected sides cut into 1 part or more, found 0")]
    NoParts,
    /// A surface is not diffuse.
    #[error("material `{name}` is {found}, expected a diffuse surface: radiosity knows no other")]
    NotDiffuse { name: String, found: &'static str },
}
