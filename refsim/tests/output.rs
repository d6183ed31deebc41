//! Proofs of the output room: comparisons, depth formats, blending laws, masks, and that tiles change nothing.

mod output {
    mod blending;
    mod depth;
    mod merging;
}
