//! The numbers that the integers in entries of a matrix, or of its biclusters, stand for.
//!
//! Shares of visibility are whole numbers of 2^-2m, so that an entry holds its number itself, in units of a power of
//! two. Where 32 bits do not hold all values in one such unit, an entry holds a number's place in a table. Both ways
//! equal integers are equal numbers, 0 is 0, and integers are ordered as their numbers are.

/// The numbers behind entries.
#[derive(Clone, Debug, PartialEq)]
pub struct EntryValues {
    /// All values of the matrix are multiples of 2^-this that 32 bits hold; `None` if there is no such unit.
    fraction_bits: Option<u32>,
    /// The unit; 1 without one.
    unit: f64,
    /// The numbers that entries name, unless entries are in units.
    table: Option<ValueTable>,
}

/// Numbers in increasing order, those below 0 first; 0 is not among them.
#[derive(Clone, Debug, PartialEq)]
struct ValueTable {
    negatives: usize,
    numbers: Vec<f64>,
}

impl ValueTable {
    /// Index in the table of an entry's integer: 1 is the least number above 0, -1 the largest below.
    fn index(&self, value: i32) -> Option<usize> {
        let beyond = self.negatives.cast_signed() as i64 + i64::from(value) - i64::from(value > 0);
        usize::try_from(beyond).ok().filter(|&index| value != 0 && index < self.numbers.len())
    }

    /// The integer of an entry for an index.
    fn entry(&self, index: usize) -> i32 {
        let from_zero = index.cast_signed() as i64 - self.negatives.cast_signed() as i64;
        (from_zero + i64::from(from_zero >= 0)) as i32
    }
}

impl EntryValues {
    /// The largest number of fraction bits of a unit: more than the difference of two f32 numbers in [0, 1] needs.
    pub const MOST_FRACTION_BITS: u32 = 30;

    /// Whole numbers of 2^-`fraction_bits`.
    ///
    /// # Panics
    /// If `fraction_bits` exceeds [`Self::MOST_FRACTION_BITS`].
    pub fn units(fraction_bits: u32) -> Self {
        assert!(fraction_bits <= Self::MOST_FRACTION_BITS, "a unit of 2^-30 or more, not 2^-{fraction_bits}");
        Self { fraction_bits: Some(fraction_bits), unit: 1.0 / f64::from(1_u32 << fraction_bits), table: None }
    }

    /// A table of finite numbers, in any order, repeated or not; zeros are left out. The values of the matrix may have
    /// a unit all the same, where those of its biclusters leave 32 bits.
    pub(super) fn table(fraction_bits: Option<u32>, numbers: impl Iterator<Item = f64>) -> Self {
        let mut numbers: Vec<f64> = numbers.filter(|&value| value != 0.0).collect();
        numbers.sort_unstable_by(f64::total_cmp);
        numbers.dedup();
        let negatives = numbers.partition_point(|&value| value < 0.0);
        let unit = fraction_bits.map_or(1.0, |bits| Self::units(bits).unit);
        Self { fraction_bits, unit, table: Some(ValueTable { negatives, numbers }) }
    }

    /// In the unit of the matrix if there is one in which 32 bits hold all numbers, else in a table.
    pub(super) fn of_numbers(fraction_bits: Option<u32>, numbers: impl Iterator<Item = f64> + Clone) -> Self {
        let units = fraction_bits.map(Self::units);
        let units = units.filter(|units| numbers.clone().all(|number| units.entry(number).is_some()));
        units.unwrap_or_else(|| Self::table(fraction_bits, numbers))
    }

    /// Number of fraction bits of the unit of which all values of the matrix are multiples, if there is one.
    pub fn fraction_bits(&self) -> Option<u32> {
        self.fraction_bits
    }

    /// The unit of entries that are in units; 1 for others.
    pub(super) fn unit(&self) -> f64 {
        self.unit
    }

    /// The number of values in the table; `None` if entries are in units.
    pub fn table_len(&self) -> Option<usize> {
        self.table.as_ref().map(|table| table.numbers.len())
    }

    /// The number that an entry holds.
    ///
    /// # Panics
    /// If the table has no such entry.
    #[inline]
    pub fn value(&self, entry: i32) -> f64 {
        match &self.table {
            None => self.unit * f64::from(entry),
            Some(table) => table.index(entry).map(|index| table.numbers[index]).expect("an entry of the table"),
        }
    }

    /// The integer of an entry for a number; `None` if it is neither a multiple of the unit that 32 bits hold nor in
    /// the table.
    pub(super) fn entry(&self, value: f64) -> Option<i32> {
        match &self.table {
            None => {
                // Exact: the unit is a power of two.
                let units = value / self.unit;
                (units == f64::from(units as i32)).then_some(units as i32)
            }
            Some(table) => {
                let found = table.numbers.binary_search_by(|other| other.total_cmp(&value));
                found.ok().map(|index| table.entry(index))
            }
        }
    }

    /// True if an entry may hold this.
    pub(super) fn has(&self, entry: i32) -> bool {
        entry != 0 && self.table.as_ref().is_none_or(|table| table.index(entry).is_some())
    }
}

impl std::fmt::Display for EntryValues {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match (self.table_len(), self.fraction_bits) {
            (None, Some(0)) => f.write_str("whole numbers"),
            (None, bits) => write!(f, "whole numbers of 2^-{}", bits.unwrap_or(0)),
            (Some(1), _) => f.write_str("1 number in a table"),
            (Some(count), _) => write!(f, "{count} numbers in a table"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_are_ordered_as_their_numbers() {
        let numbers = [2.0, -0.1, 1e-300, -1e300, 0.1, 0.0, 2.0];
        let values = EntryValues::of_numbers(Some(2), numbers.into_iter());
        assert_eq!((values.table_len(), values.fraction_bits()), (Some(5), Some(2)));
        for (entry, number) in [(-2, -1e300), (-1, -0.1), (1, 1e-300), (2, 0.1), (3, 2.0)] {
            assert_eq!((values.value(entry), values.entry(number), values.has(entry)), (number, Some(entry), true));
        }
        assert_eq!((values.entry(0.2), values.has(0), values.has(4), values.has(-3)), (None, false, false, false));
        let units = EntryValues::of_numbers(Some(2), [-3.5, 0.25].into_iter());
        assert_eq!((units.clone(), units.entry(-3.5)), (EntryValues::units(2), Some(-14)));
        assert_eq!([0.3, 1e9].map(|number| units.entry(number)), [None; 2]);
    }
}
