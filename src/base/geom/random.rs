//! A counter-based random number generator.

/// Counter-based random number generator: each number is a function of (seed, index, sample, dimension) alone, so
/// threads may draw them in any order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CounterRng {
    seed: u64,
}

impl CounterRng {
    /// Creates the generator of a seed.
    pub const fn new(seed: u64) -> Self {
        Self { seed }
    }

    /// Returns 64 random bits.
    pub const fn bits(self, index: u64, sample: u64, dimension: u64) -> u64 {
        let mut state = scramble(self.seed ^ 0x6a09_e667_f3bc_c908);
        state = scramble(state ^ index);
        state = scramble(state ^ sample.wrapping_add(0x3c6e_f372_fe94_f82b));
        scramble(state ^ dimension.wrapping_add(0x9b05_688c_2b3e_6c1f))
    }

    /// Returns a multiple of 2^-24 in [0, 1), exact in f32 and f64.
    pub fn unit(self, index: u64, sample: u64, dimension: u64) -> f64 {
        (self.bits(index, sample, dimension) >> 40) as f64 / 16_777_216.0
    }
}

/// Bijection of 64-bit words in which every input bit affects every output bit: two rounds of multiply and fold.
const fn scramble(word: u64) -> u64 {
    let mut word = word.wrapping_add(0x9e37_79b9_7f4a_7c15);
    word ^= word >> 32;
    word = word.wrapping_mul(0xd6e8_feb8_6659_fd93);
    word ^= word >> 32;
    word = word.wrapping_mul(0xd6e8_feb8_6659_fd93);
    word ^ (word >> 32)
}
