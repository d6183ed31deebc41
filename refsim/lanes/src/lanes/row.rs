//! Rows of lanes.

/// Lanes of a batch: the fragments of one 16x16 tile, lane `16 y + x`.
pub const LANES: usize = 256;

/// One value in all lanes: raw numbers of a format, masks (0 or [`TRUE`]) or integers, depending on the operation.
pub type LaneRow = [u32; LANES];

/// Lane of a mask that is true.
pub const TRUE: u32 = u32::MAX;
