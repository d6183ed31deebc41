//! Errors of the rasteriser.

use super::Primitive;

/// Error of rasterising a draw.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages explain the fields")]
pub enum RasterError {
    /// The primitive is not supported.
    #[error("expected triangles or quads, found {primitive:?}; draw thin triangles instead")]
    UnsupportedPrimitive { primitive: Primitive },
    /// The viewport exceeds the range of the set-up arithmetic.
    #[error(
        "expected a viewport of 1 to {most} pixels per side within {most} of the origin, found {width}x{height} \
         at ({x}, {y})"
    )]
    Viewport { most: u32, x: i32, y: i32, width: u32, height: u32 },
    /// The position grid is too fine.
    #[error("expected at most {most} bits of subpixel position, found {found}")]
    SubpixelBits { most: u8, found: u8 },
}
