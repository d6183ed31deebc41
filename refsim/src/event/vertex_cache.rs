//! How often a card runs its vertex program for an indexed draw: finished vertices are kept for a while.

/// How many of these vertices, each below `vertices`, are not among the `entries` last ones that came into a cache of
/// finished vertices: what is used again keeps its place in the row, and the first in goes out first.
pub fn vertex_cache_misses(indices: &[u32], vertices: usize, entries: u64) -> u64 {
    // How many had come in when this one did, itself included; 0 for none yet.
    let mut came = vec![0_u64; vertices];
    let mut misses = 0;
    for &index in indices {
        let Some(came) = came.get_mut(index as usize) else { continue };
        if *came == 0 || misses - *came >= entries {
            misses += 1;
            *came = misses;
        }
    }
    misses
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::collections::VecDeque;

    /// The definition: a row of entries, the oldest of which leaves.
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

    /// A strip of triangles as a list: two new vertices for the first pair, then one a triangle.
    #[test]
    fn a_strip_runs_each_vertex_once() {
        let strip: Vec<u32> = (0..100).flat_map(|first| [first, first + 1, first + 2]).collect();
        assert_eq!([3, 16].map(|entries| vertex_cache_misses(&strip, 102, entries)), [102; 2]);
        assert_eq!(vertex_cache_misses(&strip, 102, 0), 300);
    }
}
