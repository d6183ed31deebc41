//! Results of pixel programs, shared by the executors.

use crate::num::Format;

/// Depth written by a program: a pattern and its format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DepthValue {
    /// Format of the pattern: the register format, or single precision for `texm3x2depth`.
    pub format: Format,
    /// The pattern.
    pub bits: u32,
}

/// Result of a pixel program for one fragment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FragmentResult {
    /// `true` if `texkill` removed the fragment. The other fields are valid regardless.
    pub killed: bool,
    /// `oC0` to `oC3` in the register format. In ps_1_x, output 0 is r0 clamped to [0, 1]. Unwritten outputs are zero.
    pub colors: [[u32; 4]; 4],
    /// Depth, if the program writes it.
    pub depth: Option<DepthValue>,
}
