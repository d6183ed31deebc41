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
            0, 1, 0x007fffff, 0x00800000, 0x3f000000, 0x3effffff, 0x3f800000, 0x3f7fffff, 0x3f800001, 0x40000000,
            0x4b7fffff, 0x4b800000, 0x4b800001, 0x5f000000, 0x7f7fffff, 0x7f800000, 0x7f800001, 0x7fc00000, 0x7fffffff,
        ])
    }
}
