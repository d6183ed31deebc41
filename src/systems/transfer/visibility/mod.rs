//! Visibility maps: one bit for each of 6 x 128 x 128 directions, set if a vertex sees the light (section 4).
//!
//! - [`VisibilityMaps::trace`]: by rays;
//! - [`SegmentCensus`]: which of the light's 24 segments vertices see.

mod census;
mod maps;
mod traced;

pub use census::{SegmentCensus, segments_below_horizon};
pub use maps::{Horizon, VISIBILITY_BYTES, VisibilityCounts, VisibilityMaps, VisibilitySampling};
pub(crate) use traced::check;
