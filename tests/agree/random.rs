//! A small random stream, so that a failing case is one number.

/// A xorshift stream.
#[derive(Clone)]
pub(crate) struct Random {
    state: u64,
    /// Numbers are of ordinary size, without special values.
    pub(crate) tame: bool,
    /// Tame numbers exceed the range of short fixed-point formats.
    pub(crate) wide: bool,
}

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        let mut state = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
        state = (state ^ state >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        state = (state ^ state >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        Self { state: state | 1, tame: false, wide: false }
    }

    /// The stream of a seed within the suite `name`.
    pub(crate) fn named(name: &str, seed: u64) -> Self {
        let hash =
            name.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |h, b| (h ^ u64::from(b)).wrapping_mul(0x100_0000_01b3));
        let mut random = Self::new(hash ^ seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        random.next();
        random
    }

    pub(crate) fn next(&mut self) -> u64 {
        self.state ^= self.state << 13;
        self.state ^= self.state >> 7;
        self.state ^= self.state << 17;
        self.state >> 8
    }

    /// A number in 0..n.
    pub(crate) fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }

    /// True with probability 1 / n.
    pub(crate) fn one_in(&mut self, n: usize) -> bool {
        self.below(n) == 0
    }

    pub(crate) fn pick<'a, T: ?Sized>(&mut self, list: &[&'a T]) -> &'a T {
        list[self.below(list.len())]
    }

    pub(crate) fn choose<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.below(list.len())]
    }

    /// A number of ordinary size, at times special, as the bits of an f32.
    pub(crate) fn number(&mut self) -> u32 {
        let r = self.next();
        if self.tame {
            let scale = if self.wide { 16.0 } else { 1.0 };
            return (((r & 0xff_ffff) as f32 / 8_388_608.0 - 0.75) * scale).to_bits();
        }
        match r % 24 {
            0 => self.choose(&[0, 0x8000_0000, 0x3f80_0000, 0xbf80_0000, 0x3f00_0000, 0x4100_0000]),
            1 => self.special(),
            2 => self.next() as u32,
            3..=9 => ((r >> 8 & 0xffff) as f32 / 65536.0).to_bits(),
            10..=15 => ((r >> 8 & 0xffff) as f32 / 4096.0 - 8.0).to_bits(),
            _ => ((r >> 8 & 0xff_ffff) as f32 / 4_194_304.0 - 2.0).to_bits(),
        }
    }

    /// A number that formats treat specially: infinities, NaN, the smallest and the largest numbers.
    pub(crate) fn special(&mut self) -> u32 {
        self.choose(&[
            0x7f80_0000,
            0xff80_0000,
            0x7fc0_0000,
            0xffc0_0001,
            0x0000_0001,
            0x0070_0000,
            0x8000_0001,
            0x7f7f_ffff,
            0xff7f_ffff,
            0x4780_0000,
            0x3880_0000,
        ])
    }

    pub(crate) fn vector(&mut self) -> [u32; 4] {
        [self.number(), self.number(), self.number(), self.number()]
    }
}
