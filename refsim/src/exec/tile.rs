//! Interface between the machine and its tile executors.
//!
//! The machine divides the targets into tiles, passes each tile with its candidate triangles to the executor, and sums
//! the returned counts. Tiles are independent, so they are processed in parallel and in any order with the same result.

use super::{CheckedProgram, PixelBindings};
use crate::device::Rules;
use crate::output::OutputState;

/// Side length of a tile in pixels. Tile positions are multiples of this length; tiles at the far edges of the targets
/// are smaller.
pub const TILE: u32 = 16;

/// Parameters of a draw from which an executor is created.
#[derive(Clone, Copy, Debug)]
pub struct TileDraw<'a> {
    /// The pixel program.
    pub program: &'a CheckedProgram,
    /// Arithmetic rules of the device.
    pub rules: &'a Rules,
    /// Constants, textures, stage state.
    pub bindings: PixelBindings<'a>,
    /// Tests, blending, masks.
    pub output: OutputState,
    /// Step budget per fragment.
    pub step_budget: u32,
}
