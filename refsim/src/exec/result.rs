//! What pixel programs leave behind: shared by the executors.

use crate::num::Format;

/// Depth that a program decided: a pattern and its format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DepthValue {
    /// Format of the pattern: the register format, or single precision for `texm3x2depth`.
    pub format: Format,
    /// The pattern.
    pub bits: u32,
}

/// What a pixel program made of one fragment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FragmentResult {
    /// Whether `texkill` removed it. The other fields are filled in all the same.
    pub killed: bool,
    /// `oC0` to `oC3` in the register format. In ps_1_x the first is r0 clamped to [0, 1]. What the program does not
    /// write is zero.
    pub colors: [[u32; 4]; 4],
    /// Depth, if the program decides it.
    pub depth: Option<DepthValue>,
}
