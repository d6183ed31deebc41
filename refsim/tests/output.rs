//! Tests of `refsim::output`: comparisons, depth formats, blending properties, masks, and independence of tiles.

mod output {
    mod blending;
    mod depth;
    mod merging;
}
