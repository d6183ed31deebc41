//! Counter-based random words for stochastic rounding.

/// The random word of operation `index`: the upper half of output `index` (from 0) of SplitMix64 (Steele, Lea and Flood
/// 2014, "Fast splittable pseudorandom number generators") seeded with `seed`. It only depends on `seed` and
/// `index`, not on earlier calls.
///
/// ```
/// // The first two outputs for the seed 1234567 are 6457827717110365317 and 3203168211198807973.
/// use refsim_lanes::num::random_word;
/// assert_eq!(random_word(1_234_567, 0), (6_457_827_717_110_365_317_u64 >> 32) as u32);
/// assert_eq!(random_word(1_234_567, 1), (3_203_168_211_198_807_973_u64 >> 32) as u32);
/// ```
pub const fn random_word(seed: u64, index: u64) -> u32 {
    let state = seed.wrapping_add(index.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15));
    let mixed = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((mixed ^ (mixed >> 31)) >> 32) as u32
}
