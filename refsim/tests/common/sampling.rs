//! Sampling rules by number.

use refsim::texture::{BorderStorage, FilterArithmetic, MissingChannels, TexelValues, WeightRounding};

/// The sampling rules that have two values each; each bit of `number` selects the value of one rule.
pub(crate) fn switched(number: u32) -> (WeightRounding, FilterArithmetic, TexelValues, MissingChannels, BorderStorage) {
    fn of<T: Copy>(all: &[T], bit: u32) -> T {
        all[bit as usize & 1]
    }
    (
        of(WeightRounding::ALL, number),
        of(FilterArithmetic::ALL, number >> 1),
        of(TexelValues::ALL, number >> 2),
        of(MissingChannels::ALL, number >> 3),
        of(BorderStorage::ALL, number >> 4),
    )
}
