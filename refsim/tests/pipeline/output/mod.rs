//! Tests of `refsim::output`: comparisons, depth formats, blending properties, masks, and independence of tiles.

mod blending;
mod depth;
mod merging;
