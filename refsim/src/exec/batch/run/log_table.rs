//! Logarithms of singles by a table.

const FRACTION: u32 = 23;
/// Leading fraction bits that index the table. An interval is narrower than a step of 2^(1/256), so it contains at most
/// one step.
const LEADING: u32 = 9;

/// Table of `floor(2^bits log2 m)` for significands `m` from 1 to 2.
#[derive(Debug)]
pub(super) struct LogTable {
    pub(super) bits: u8,
    /// The value at the start of an interval, and the fraction at which it increases by one; by leading fraction bits.
    entries: Vec<(i32, u32)>,
}

impl LogTable {
    /// Creates the table for `bits` fraction bits, at most 8.
    ///
    /// The fraction at which the logarithm reaches `k 2^-bits` is rounded up from a product of at most eight roots of
    /// 2, in double precision. Its error is less than 2^-24 units in the last place of a single, and none of the 255
    /// numbers `2^(k/256)` is closer to a single than 2^-16 units.
    pub(super) fn new(bits: u8) -> Self {
        let one = f64::from(1u32 << FRACTION);
        let steps = 1i32 << bits;
        let reached = |k: i32| {
            let (mut root, mut power) = (2.0_f64, one);
            for bit in (0..bits).rev() {
                root = root.sqrt();
                power *= if k >> bit & 1 == 1 { root } else { 1.0 };
            }
            power.ceil() as u32 - (1 << FRACTION)
        };
        let thresholds: Vec<u32> = (1..steps).map(reached).collect();
        let entry = |leading: u32| {
            let first = leading << (FRACTION - LEADING);
            let value = thresholds.partition_point(|&threshold| threshold <= first);
            ((value as u32).cast_signed(), thresholds.get(value).copied().unwrap_or(u32::MAX))
        };
        Self { bits, entries: (0..1 << LEADING).map(entry).collect() }
    }

    /// Computes log2(x) / 2 of a non-negative single, rounded down to the table's bits.
    #[inline(always)]
    pub(super) fn half_log2(&self, x: f32) -> f32 {
        // Subnormal singles are normal doubles.
        let bits = f64::from(x).to_bits();
        let fraction = (bits >> (52 - FRACTION)) as u32 & ((1 << FRACTION) - 1);
        let (value, threshold) = self.entries[(fraction >> (FRACTION - LEADING)) as usize & ((1 << LEADING) - 1)];
        let exponent = (bits >> 52) as i32 - 1023;
        let whole = (exponent << self.bits) + value + i32::from(fraction >= threshold);
        let finite = (whole >> 1) as f32 * (1.0 / (1u32 << self.bits) as f32);
        let large = if x == f32::INFINITY { 127.0 } else { finite };
        let some = if x == 0.0 { -127.0 } else { large };
        if x.is_nan() { 0.0 } else { some }
    }
}
