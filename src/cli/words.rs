//! Words for what the emulator names by types.

use refsim::{isa::Mask, output::FragmentFate};

use crate::report::digits::{Quantity, count, shown};

/// The stage at which a fragment ended.
pub(super) const fn fate(fate: FragmentFate) -> &'static str {
    match fate {
        FragmentFate::KilledByShader => "is killed by the program",
        FragmentFate::AlphaFailed => "fails the alpha test",
        FragmentFate::DepthFailed => "fails the depth test",
        FragmentFate::Passed => "passes",
        FragmentFate::OutsideTile => "lies outside",
    }
}

/// A number of things, for a sentence: `177,694`.
pub(super) fn counted(number: usize) -> String {
    count(number as u64)
}

/// A measured number, for a sentence: `39.57`, `0.0001235`.
pub(super) fn measured(number: f64) -> String {
    shown(number, Quantity::Measured)
}

/// The components of a mask: `xz`.
pub(super) fn letters(mask: Mask) -> String {
    mask.components().map(|c| ['x', 'y', 'z', 'w'][c]).collect()
}
