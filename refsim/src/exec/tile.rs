//! What the machine tells a pixel executor of a draw.
//!
//! The machine cuts the targets into tiles, hands each to the executor with the triangles that may touch it, and adds
//! up what comes back. An executor sees one tile at a time and nothing else, so tiles run side by side in any order
//! with the same result.

use super::{CheckedProgram, PixelBindings};
use crate::device::Rules;
use crate::output::{OutputRules, OutputState};

/// Side of a tile in pixels. Tiles start at multiples of it; those at the far edges of the targets are smaller.
pub const TILE: u32 = 16;

/// What stays the same over a draw: what an executor is made from.
#[derive(Clone, Copy, Debug)]
pub struct TileDraw<'a> {
    /// The pixel program.
    pub program: &'a CheckedProgram,
    /// How the device computes.
    pub rules: &'a Rules,
    /// Constants, textures, stage state.
    pub bindings: PixelBindings<'a>,
    /// Tests, blending, masks.
    pub output: OutputState,
    /// Steps that a fragment may make.
    pub step_budget: u32,
}

/// What a device says about targets, out of its rules.
pub fn output_rules(rules: &Rules) -> OutputRules {
    OutputRules { format: rules.format, target_rounding: rules.target_rounding, depth_rounding: rules.depth_rounding }
}
