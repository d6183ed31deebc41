//! Errors of the rasteriser.

use super::Primitive;

/// Why a draw can't be rasterised.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RasterError {
    /// The emulator has no rule for this primitive.
    #[error("expected triangles or quads, found {primitive:?}; draw thin triangles instead")]
    UnsupportedPrimitive {
        /// What was asked for.
        primitive: Primitive,
    },
    /// The viewport is larger than the arithmetic of the set-up allows.
    #[error(
        "expected a viewport of 1 to {most} pixels a side within {most} of the origin, found {width}x{height} at ({x}, {y})"
    )]
    Viewport {
        /// The largest side.
        most: u32,
        /// Left edge.
        x: i32,
        /// Top edge.
        y: i32,
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
    },
    /// Too fine a grid of positions.
    #[error("expected at most {most} bits of subpixel position, found {found}")]
    SubpixelBits {
        /// The finest grid.
        most: u8,
        /// The grid asked for.
        found: u8,
    },
}
