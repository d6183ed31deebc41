//! A stream of random numbers, by which a failing case is known by its seed.
#![allow(dead_code, reason = "shared by several test binaries, each of which takes what it needs")]

use std::fmt::Debug;

/// Stream of a seed, the same on every machine: the splitmix64 recurrence, which `fixtures/formats/make_tables.py` has,
/// too.
#[derive(Clone)]
pub(crate) struct Random(u64);

impl Random {
    pub(crate) const fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// 64 random bits.
    pub(crate) const fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// 32 random bits.
    pub(crate) const fn bits(&mut self) -> u32 {
        (self.next() >> 32) as u32
    }

    /// A number in 0..n.
    pub(crate) fn below<N: TryFrom<u64, Error: Debug> + TryInto<u64, Error: Debug>>(&mut self, n: N) -> N {
        let n: u64 = n.try_into().expect("a count");
        N::try_from(self.next() % n).expect("below a number of the type")
    }

    /// Heads or tails.
    pub(crate) const fn coin(&mut self) -> bool {
        self.next() >> 63 == 1
    }

    /// An element of a list.
    pub(crate) fn of<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.below(list.len())]
    }

    /// A multiple of 2^-24 in [0, 1).
    pub(crate) const fn unit(&mut self) -> f32 {
        (self.next() >> 40) as f32 / 16_777_216.0
    }

    /// A number in [low, high).
    pub(crate) const fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.unit()
    }

    /// A byte of a texel: one time in four at an end of the range of a code.
    pub(crate) fn code(&mut self) -> u8 {
        if self.below(4) == 0 { self.of(&[0, 0x7f, 0x80, 0xff]) } else { self.next() as u8 }
    }
}
