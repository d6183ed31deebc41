//! A stream of random numbers; its seed identifies a failing case.
#![allow(dead_code, reason = "shared by several test binaries, each of which takes what it needs")]

use std::fmt::Debug;

/// Random numbers from a seed, equal on every host: the splitmix64 recurrence, as in `fixtures/formats/make_tables.py`.
#[derive(Clone)]
pub(crate) struct Random {
    state: u64,
    /// [`Self::number`] returns numbers of ordinary size, without special values.
    pub(crate) tame: bool,
    /// [`Self::number`] also returns numbers beyond the range of short fixed-point formats, even if `tame`.
    pub(crate) wide: bool,
}

impl Random {
    pub(crate) const fn new(seed: u64) -> Self {
        Self { state: seed, tame: false, wide: false }
    }

    /// The stream of a seed within the suite `name`.
    pub(crate) fn named(name: &str, seed: u64) -> Self {
        let hash =
            name.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |h, b| (h ^ u64::from(b)).wrapping_mul(0x100_0000_01b3));
        Self::new(Self::new(hash ^ seed.wrapping_mul(0x9e37_79b9_7f4a_7c15)).next())
    }

    /// 64 random bits.
    pub(crate) const fn next(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
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

    /// True with probability 1 / n.
    pub(crate) fn one_in(&mut self, n: u64) -> bool {
        self.below(n) == 0
    }

    /// Heads or tails.
    pub(crate) const fn coin(&mut self) -> bool {
        self.next() >> 63 == 1
    }

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

    /// A byte of a texel: one time in four 0, 0x7f, 0x80 or 0xff.
    pub(crate) fn code(&mut self) -> u8 {
        if self.below(4) == 0 { self.of(&[0, 0x7f, 0x80, 0xff]) } else { self.next() as u8 }
    }

    /// A number, mostly of ordinary size and sometimes special, as the bits of an f32.
    pub(crate) fn number(&mut self) -> u32 {
        let r = self.next();
        if self.tame {
            let scale = if self.wide { 16.0 } else { 1.0 };
            return (((r & 0xff_ffff) as f32 / 8_388_608.0 - 0.75) * scale).to_bits();
        }
        match r % 24 {
            0 => self.of(&[0, 0x8000_0000, 0x3f80_0000, 0xbf80_0000, 0x3f00_0000, 0x4100_0000]),
            1 => self.special(),
            2 => self.next() as u32,
            3..=9 => ((r >> 8 & 0xffff) as f32 / 65536.0).to_bits(),
            10..=15 => ((r >> 8 & 0xffff) as f32 / 4096.0 - 8.0).to_bits(),
            _ => ((r >> 8 & 0xff_ffff) as f32 / 4_194_304.0 - 2.0).to_bits(),
        }
    }

    /// A number that formats treat specially: infinities, NaN, the smallest and the largest numbers.
    pub(crate) fn special(&mut self) -> u32 {
        self.of(&[
            0x7f800000, 0xff800000, 0x7fc00000, 0xffc00001, 0x00000001, 0x00700000, 0x80000001, 0x7f7fffff, 0xff7fffff,
            0x47800000, 0x38800000,
        ])
    }

    pub(crate) fn vector(&mut self) -> [u32; 4] {
        [self.number(), self.number(), self.number(), self.number()]
    }
}
