//! Why there are no pictures of bi-scale transfer.

use miette::Diagnostic;
use thiserror::Error;

use crate::picture::PictureError;
use crate::transfer::light::CubeLightError;

/// Why there are no pictures.
#[non_exhaustive]
#[derive(Debug, Error, Diagnostic)]
pub enum BiScaleError {
    /// A light that is none.
    #[error(transparent)]
    #[diagnostic(code(crossbar::prt::light))]
    Light(#[from] CubeLightError),
    /// A matrix that is no transfer of a mesh.
    #[error("expected transfer of a mesh, found a matrix of something else")]
    #[diagnostic(
        code(crossbar::prt::meaning),
        help("name what `crossbar bi-scale precompute` wrote, or its biclusters")
    )]
    NoTransfer,
    /// A texture of other directions than the transfer.
    #[error("{name}: expected {expected} directions of light, as the transfer has, found {found}")]
    #[diagnostic(
        code(crossbar::prt::directions),
        help("make the texture, or the transfer, with the other's `--directions`")
    )]
    Directions {
        /// The texture.
        name: String,
        /// M of the transfer.
        expected: usize,
        /// M of the texture.
        found: usize,
    },
    /// A picture by rays of a texture that is only samples.
    #[error("{name}: expected a patch of heights to cast rays at, found samples alone")]
    #[diagnostic(code(crossbar::prt::no_patch), help("name a patch, such as `mail`, in place of a file"))]
    NoPatch {
        /// The texture.
        name: String,
    },
    /// A picture that cannot be shown.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Picture(#[from] PictureError),
}
