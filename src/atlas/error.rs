//! Why a mesh has no atlas.

use thiserror::Error;

/// Why a mesh has no atlas of a size.
#[non_exhaustive]
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum AtlasError {
    /// There is nothing to map.
    #[error("the mesh has no faces, expected at least one")]
    NoFaces,
    /// All faces are points or lines.
    #[error("all of the {faces} faces have zero area, expected at least one with an area")]
    NoArea { faces: usize },
    /// The size is not one that can be halved down to a texel, or too large.
    #[error("found an atlas of {side} x {side} texels, expected a side that is a power of two, up to {most}")]
    Side { side: u32, most: u32 },
    /// Every face needs a texel.
    #[error(
        "{faces} faces do not fit into an atlas of {side} x {side} texels, expected a side of at least {least}: every \
         face needs a texel"
    )]
    TooManyFaces { faces: usize, side: u32, least: u32 },
    /// Not even the largest atlas has a texel for every face.
    #[error("found {faces} faces, expected at most {most}: one for every texel of the largest atlas")]
    TooLarge { faces: usize, most: u64 },
}
