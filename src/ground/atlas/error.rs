//! Errors of building an atlas.

use thiserror::Error;

/// Error of building an atlas of a given size.
#[non_exhaustive]
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum AtlasError {
    /// The mesh has no faces.
    #[error("the mesh has no faces, expected at least one")]
    NoFaces,
    /// All faces are degenerate.
    #[error("all of the {faces} faces have zero area, expected at least one with an area")]
    NoArea { faces: usize },
    /// The side is not a power of two, or too large.
    #[error("found an atlas of {side} x {side} texels, expected a side that is a power of two, up to {most}")]
    Side { side: u32, most: u32 },
    /// There are more faces than texels.
    #[error(
        "{faces} faces do not fit into an atlas of {side} x {side} texels, expected a side of at least {least}: every \
         face needs a texel"
    )]
    TooManyFaces { faces: usize, side: u32, least: u32 },
    /// There are more faces than the largest atlas has texels.
    #[error("found {faces} faces, expected at most {most}: one for every texel of the largest atlas")]
    TooLarge { faces: usize, most: u64 },
}
