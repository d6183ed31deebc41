//! Visibility maps: in which of 6 x 128 x 128 directions a vertex sees the light (section 4), a bit each.
//!
//! - [`VisibilityMaps::trace`]: by rays;
//! - [`SegmentCensus`]: which of the 24 segments of the light a vertex sees at all.

mod census;
mod maps;
mod traced;

pub use census::{SegmentCensus, segments_below_horizon};
pub use maps::{Horizon, VISIBILITY_BYTES, VisibilityCounts, VisibilityMaps, VisibilitySampling};
pub(crate) use traced::check;
