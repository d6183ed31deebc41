//! Deterministic pseudo-random numbers.

/// A splitmix64 generator.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// 32 bits.
    pub(crate) fn bits(&mut self) -> u32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) as u32
    }

    /// Below `n`.
    pub(crate) fn below(&mut self, n: u32) -> u32 {
        ((u64::from(self.bits()) * u64::from(n)) >> 32) as u32
    }

    /// An element of a list.
    pub(crate) fn of<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.below(list.len() as u32) as usize]
    }

    /// From `low` to `high`.
    pub(crate) fn real(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * (self.bits() >> 8) as f32 / 16_777_216.0
    }

    /// A number of either sign with a magnitude from `2^low` to `2^high`.
    pub(crate) fn spread(&mut self, low: i32, high: i32) -> f32 {
        let exponent = low + self.below((high - low) as u32).cast_signed();
        let magnitude = f32::from_bits((exponent + 127).cast_unsigned() << 23) * self.real(1.0, 2.0);
        if self.bits() & 1 == 0 { magnitude } else { -magnitude }
    }

    /// A boundary pattern.
    pub(crate) fn edge(&mut self) -> u32 {
        let sign = self.bits() & 0x8000_0000;
        sign | self.of(&[
            0,
            1,
            0x007f_ffff,
            0x0080_0000,
            0x3f00_0000,
            0x3eff_ffff,
            0x3f80_0000,
            0x3f7f_ffff,
            0x3f80_0001,
            0x4000_0000,
            0x4b7f_ffff,
            0x4b80_0000,
            0x4b80_0001,
            0x5f00_0000,
            0x7f7f_ffff,
            0x7f80_0000,
            0x7f80_0001,
            0x7fc0_0000,
            0x7fff_ffff,
        ])
    }
}
