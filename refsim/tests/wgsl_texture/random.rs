//! Numbers for texture reads.

pub(crate) use crate::stream::Random;

impl Random {
    /// A number of either sign with a magnitude from `2^low` to `2^high`.
    pub(crate) fn spread(&mut self, low: i32, high: i32) -> f32 {
        let exponent = low + self.below(high - low);
        let magnitude = f32::from_bits((exponent + 127).cast_unsigned() << 23) * self.between(1.0, 2.0);
        if self.coin() { magnitude } else { -magnitude }
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
