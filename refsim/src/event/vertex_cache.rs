//! Post-transform vertex cache: number of vertex program executions of an indexed draw.

/// Number of misses of the indices, each below `vertices`, in a first-in, first-out cache of `entries` transformed
/// vertices. A hit does not change the order of eviction.
pub fn vertex_cache_misses(indices: &[u32], vertices: usize, entries: u64) -> u64 {
    // Per vertex, the miss count when it last entered, including itself; 0 if it never did.
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
}
