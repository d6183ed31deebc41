//! Tests of `refsim::output`: comparisons, depth formats, masks, and independence of tiles.

mod depth;
mod merging;
