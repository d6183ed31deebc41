//! Why a scene cannot be cut into patches.

use thiserror::Error;

use crate::linalg::MAX_SQUARE;

/// The most patches: those of the largest matrix.
pub const MAX_PATCHES: usize = MAX_SQUARE;

/// A scene cannot be cut into patches.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Error)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum PatchError {
    /// No triangles.
    #[error("expected a scene with surfaces, found none")]
    Empty,
    /// A triangle without area.
    #[error("triangle {triangle} (counted from 0) has no area; remove it, or merge its corners")]
    ZeroArea { triangle: u32 },
    /// More patches than the largest matrix has rows.
    #[error("expected at most {MAX_PATCHES} patches, found {found}; cut the faces into fewer")]
    TooMany { found: usize },
    /// Sides cut into no parts.
    #[error("expected sides cut into 1 part or more, found 0")]
    NoParts,
    /// A surface that is not diffuse.
    #[error("material `{name}` is {found}, expected a diffuse surface: radiosity knows no other")]
    NotDiffuse { name: String, found: &'static str },
}
