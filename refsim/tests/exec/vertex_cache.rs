//! Misses of the vertex cache.

use std::collections::VecDeque;

use proptest::prelude::*;
use refsim::event::vertex_cache_misses;

/// Reference implementation with an explicit queue.
fn by_definition(indices: &[u32], entries: usize) -> u64 {
    let mut row = VecDeque::new();
    let mut misses = 0;
    for index in indices {
        if !row.contains(index) {
            misses += 1;
            row.push_back(*index);
            if row.len() > entries {
                row.pop_front();
            }
        }
    }
    misses
}

proptest! {
    #[test]
    fn a_vertex_leaves_after_as_many_as_there_are_entries(
        indices in prop::collection::vec(0_u32..12, 0..80),
        entries in 0_usize..14,
    ) {
        prop_assert_eq!(vertex_cache_misses(&indices, 12, entries as u64), by_definition(&indices, entries));
    }
}
