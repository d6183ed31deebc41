//! Rows of lanes.

/// Lanes of a batch: the fragments of one 16x16 tile, lane `16 y + x`.
pub const LANES: usize = 256;

/// All lanes of one value: raw numbers of a format, masks (0 or [`TRUE`]) or integers, as the operation that reads them
/// takes them.
pub type LaneRow = [u32; LANES];

/// A lane of a mask that holds.
pub const TRUE: u32 = u32::MAX;
