//! Post-transform vertex cache: number of vertex program executions of an indexed draw.

/// Number of misses in a first-in, first-out cache of `entries` transformed vertices, for indices below `vertices`. A
/// hit does not change the order of eviction.
pub fn vertex_cache_misses(indices: &[u32], vertices: usize, entries: u64) -> u64 {
    // For each vertex, the number of misses when it last entered the cache, counting its own; 0 if it never entered.
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
