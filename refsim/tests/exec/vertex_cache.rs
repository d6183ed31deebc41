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

/// A triangle strip as a list: two new vertices for the first pair, then one per triangle.
#[test]
fn a_strip_runs_each_vertex_once() {
    let strip: Vec<u32> = (0..100).flat_map(|first| [first, first + 1, first + 2]).collect();
    assert_eq!([3, 16].map(|entries| vertex_cache_misses(&strip, 102, entries)), [102; 2]);
    assert_eq!(vertex_cache_misses(&strip, 102, 0), 300);
}
