//! Alpha test, depth test, blending and masked write of a fragment.

use super::MAX_TARGETS;
use super::blend::{BlendState, blend_texel};
use super::depth::{CompareFunction, DepthState};
use super::tile::{ColorTile, TargetTile};
use crate::device::Rules;
use crate::num::{self, Format};
use crate::texture::{TargetRounding, encode};

/// A device's rules for render targets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OutputRules {
    /// Format of pixel program outputs.
    pub format: Format,
    /// Rounding into fixed-point colour targets.
    pub target_rounding: TargetRounding,
    /// Rounding into fixed-point depth buffers.
    pub depth_rounding: TargetRounding,
}

impl From<&Rules> for OutputRules {
    fn from(rules: &Rules) -> Self {
        Self { format: rules.format, target_rounding: rules.target_rounding, depth_rounding: rules.depth_rounding }
    }
}

/// The alpha test: compares alpha of colour 0 with a reference in the register format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct AlphaTest {
    /// The comparison that passes.
    pub function: CompareFunction,
    /// The reference, FP32 bits; converted to the register format once.
    pub reference: u32,
}

/// Set of written components: bit 0 is red, bit 3 alpha.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct WriteMask(pub u8);

impl WriteMask {
    /// Red, green, blue and alpha.
    pub const ALL: Self = Self(15);
    /// Nothing.
    pub const NONE: Self = Self(0);

    /// Returns `true` if the component (0 red to 3 alpha) is written.
    pub const fn has(self, component: u8) -> bool {
        self.0 >> component & 1 == 1
    }
}

impl Default for WriteMask {
    fn default() -> Self {
        Self::ALL
    }
}

/// The state of the output stage.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct OutputState {
    /// Alpha test, if enabled.
    pub alpha: Option<AlphaTest>,
    /// Depth test.
    pub depth: DepthState,
    /// Blending, if enabled.
    pub blend: Option<BlendState>,
    /// Write masks of the targets.
    pub masks: [WriteMask; MAX_TARGETS],
}

/// Outputs of a pixel program; numbers in the register format.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FragmentOutput {
    /// Colour per target.
    pub colors: [[u32; 4]; MAX_TARGETS],
    /// Bit `i` is set if colour `i` was written; targets without a colour keep their contents.
    pub written: u8,
    /// Depth written by the program; `None`: the interpolated depth.
    pub depth: Option<u32>,
    /// `true` if the program killed the fragment.
    pub killed: bool,
}

/// Outcome of a fragment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FragmentFate {
    /// Killed by the pixel program.
    KilledByShader,
    /// Failed the alpha test.
    AlphaFailed,
    /// Failed the depth test.
    DepthFailed,
    /// Written to the targets.
    Passed,
    /// Outside the tile; nothing was done.
    OutsideTile,
}

impl AlphaTest {
    /// Returns `true` if an alpha in the register format passes. NaN passes only `NotEqual` and `Always`.
    pub fn passes(&self, alpha: u32, format: Format) -> bool {
        use std::cmp::Ordering::{Equal, Greater, Less};
        let reference = num::ops::convert(&Format::FP32, format, self.reference).bits;
        let order = if format.is_nan(alpha) || format.is_nan(reference) {
            None
        } else if num::ops::lt(format, alpha, reference).bits != 0 {
            Some(Less)
        } else if num::ops::lt(format, reference, alpha).bits != 0 {
            Some(Greater)
        } else {
            Some(Equal)
        };
        self.function.holds(order)
    }
}

/// Applies alpha test, depth test, blending and write masks to a fragment, and writes it into a tile.
///
/// `depth` is the interpolated depth, FP32 bits. A depth written by the program replaces it, converted once from the
/// register format to the depth format.
pub fn merge(
    tile: &mut TargetTile,
    (x, y): (u32, u32),
    fragment: &FragmentOutput,
    depth: u32,
    state: &OutputState,
    rules: &OutputRules,
) -> FragmentFate {
    let Some(index) = tile.index(x, y) else { return FragmentFate::OutsideTile };
    if fragment.killed {
        return FragmentFate::KilledByShader;
    }
    if state.alpha.is_some_and(|test| !test.passes(fragment.colors[0][3], rules.format)) {
        return FragmentFate::AlphaFailed;
    }
    if let (Some(buffer), Some(function)) = (&mut tile.depth, state.depth.test) {
        let new = match fragment.depth {
            Some(own) => buffer.format.quantise(rules.format, own, rules.depth_rounding),
            None => buffer.format.quantise(Format::FP32, depth, rules.depth_rounding),
        };
        if let Some(old) = buffer.data.get_mut(index) {
            if !function.holds(Some(new.cmp(old))) {
                return FragmentFate::DepthFailed;
            }
            if state.depth.write {
                *old = new;
            }
        }
    }
    for (i, target) in tile.colors.iter_mut().enumerate() {
        if let Some(target) = target
            && fragment.written >> i & 1 == 1
        {
            write_color(target, index, fragment.colors[i], state, state.masks[i], rules);
        }
    }
    FragmentFate::Passed
}

fn write_color(
    target: &mut ColorTile,
    index: usize,
    color: [u32; 4],
    state: &OutputState,
    mask: WriteMask,
    rules: &OutputRules,
) {
    let format = target.format;
    let writes = format.record().stored().iter().filter(|c| mask.has(c.stored_from));
    // Bits of the written channels; other bits are kept.
    let bits = writes.fold(0u128, |bits, c| bits | (u128::from(u32::MAX >> (32 - c.bits)) << c.shift));
    if bits == 0 {
        return;
    }
    let old = target.raw(index);
    let new = match &state.blend {
        Some(blend) => blend_texel(format, old, rules.format, color, blend, rules.target_rounding),
        None => encode(format, rules.format, color, rules.target_rounding),
    };
    target.set_raw(index, old & !bits | new & bits);
}
