//! The fragment programs of matrix radiosity as text. Solver programs are written for a block of one texel; the marked
//! part is unrolled for each texel of a block, since these programs have no loops. Display programs are complete.

use super::packing::Packing;
use crate::card::{KernelText, kernels};

kernels! {
    /// Solver programs, to be unrolled for a block.
    BLOCKS:
    RGB_FIRST "rgb_first.fp"
    RGB_NEXT "rgb_next.fp"
    LUMINANCE_FIRST "luminance_first.fp"
    LUMINANCE_NEXT "luminance_next.fp"
    RGB_FIRST_HALF "rgb_first_half.fp"
    RGB_NEXT_HALF "rgb_next_half.fp"
    LUMINANCE_FIRST_HALF "luminance_first_half.fp"
    LUMINANCE_NEXT_HALF "luminance_next_half.fp"
}

kernels! {
    /// Display programs.
    DRAWING:
    FLAT "flat.fp"
    ID "id.fp"
    RESAMPLE "resample.fp"
    SMOOTH_QUAD "smooth_quad.fp"
    SMOOTH_TRIANGLE "smooth_triangle.fp"
}

/// The programs of the first pass of an iteration and of the later ones.
pub fn of(packing: Packing, half: bool) -> [KernelText; 2] {
    match (packing, half) {
        (Packing::Rgb, false) => [RGB_FIRST, RGB_NEXT],
        (Packing::Rgb, true) => [RGB_FIRST_HALF, RGB_NEXT_HALF],
        (Packing::Luminance, false) => [LUMINANCE_FIRST, LUMINANCE_NEXT],
        (Packing::Luminance, true) => [LUMINANCE_FIRST_HALF, LUMINANCE_NEXT_HALF],
    }
}
