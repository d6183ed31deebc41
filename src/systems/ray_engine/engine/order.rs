//! Order in which the rays of a bundle enter the tree.

use crate::geom::random::CounterRng;

/// Returns a permutation of `count` rays: the identity, or shuffled (section 5.3: "in random order, which helps keep
/// the tree balanced") by a seed and the index of the first ray.
pub(super) fn order(count: usize, shuffled: Option<(u64, u64)>) -> Vec<usize> {
    let mut places: Vec<usize> = (0..count).collect();
    if let Some((seed, first)) = shuffled {
        let random = CounterRng::new(seed);
        for last in (1..count).rev() {
            let bits = random.bits(first, last as u64, 0);
            // The high half of the product is almost uniform for any possible number of rays.
            places.swap(last, ((u128::from(bits) * (last as u128 + 1)) >> 64) as usize);
        }
    }
    places
}
