//! Contents of the targets at one pixel.

use crate::output::{MAX_TARGETS, TargetTile};

/// Contents of the targets at one pixel, as stored.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PixelState {
    /// The texel of each colour target, as a little-endian integer.
    pub colors: [Option<u128>; MAX_TARGETS],
    /// The bit pattern in the depth buffer.
    pub depth: Option<u32>,
}

impl PixelState {
    pub(super) fn of(tile: &TargetTile) -> Self {
        Self {
            colors: [0, 1, 2, 3].map(|i: usize| tile.colors[i].as_ref().map(|target| target.raw(0))),
            depth: tile.depth.as_ref().and_then(|depth| depth.data.first().copied()),
        }
    }
}
