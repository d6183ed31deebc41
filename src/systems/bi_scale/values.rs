//! The numbers that the integers in entries of a matrix, or of its biclusters, stand for.
//!
//! Shares of visibility are whole numbers of 2^-2m, so that an entry holds its number itself, in units of a power of
//! two. Where 32 bits do not hold all values in one such unit, an entry holds a number's place in a table. Both ways
//! equal integers are equal numbers, 0 is 0, and integers are ordered as their numbers are.

use super::exact::ExactNumber;

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
pub(super) struct ValueTable {
    pub(super) negatives: usize,
    /// The nearest f64 of each.
    pub(super) nearest: Vec<f64>,
    /// Index and number of those that no f64 holds, by increasing index.
    pub(super) wide: Vec<(u32, ExactNumber)>,
}

impl ValueTable {
    /// Of increasing numbers other than 0.
    fn new(numbers: &[ExactNumber]) -> Self {
        let nearest: Vec<f64> = numbers.iter().map(ExactNumber::nearest).collect();
        let wide = (0..).zip(numbers).filter(|(_, number)| number.double().is_none());
        let wide = wide.map(|(index, number)| (index, number.clone())).collect();
        // The nearest f64 of such a number is not 0: all are multiples of the finest f64.
        Self { negatives: nearest.partition_point(|&value| value < 0.0), nearest, wide }
    }

    /// Index in the table of an entry's integer: 1 is the least number above 0, -1 the largest below.
    fn index(&self, value: i32) -> Option<usize> {
        let beyond = self.negatives.cast_signed() as i64 + i64::from(value) - i64::from(value > 0);
        usize::try_from(beyond).ok().filter(|&index| value != 0 && index < self.nearest.len())
    }

    /// The integer of an entry for an index.
    fn entry(&self, index: usize) -> i32 {
        let from_zero = index.cast_signed() as i64 - self.negatives.cast_signed() as i64;
        (from_zero + i64::from(from_zero >= 0)) as i32
    }

    fn exact(&self, index: usize) -> ExactNumber {
        match self.wide.binary_search_by_key(&(index as u32), |(index, _)| *index) {
            Ok(at) => self.wide[at].1.clone(),
            Err(_) => ExactNumber::of(self.nearest[index]),
        }
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

    /// Distinct finite numbers other than 0, in increasing order, in a table.
    pub(super) fn of_doubles(nearest: Vec<f64>) -> Self {
        let negatives = nearest.partition_point(|&value| value < 0.0);
        Self::of_table(None, ValueTable { negatives, nearest, wide: Vec::new() })
    }

    /// A table; the values of the matrix may have a unit all the same, where those of its biclusters leave 32 bits.
    pub(super) fn of_table(fraction_bits: Option<u32>, table: ValueTable) -> Self {
        let unit = fraction_bits.map_or(1.0, |bits| Self::units(bits).unit);
        Self { fraction_bits, unit, table: Some(table) }
    }

    /// Distinct numbers other than 0, in increasing order: in the unit of the matrix if there is one in which 32 bits
    /// hold all, else in a table. Returns also the integer of an entry for each.
    pub(super) fn of_numbers(fraction_bits: Option<u32>, numbers: &[ExactNumber]) -> (Self, Vec<i32>) {
        if let Some(bits) = fraction_bits {
            let units = |number: &ExactNumber| i32::try_from(number.in_units(-bits.cast_signed())?).ok();
            if let Some(entries) = numbers.iter().map(units).collect() {
                return (Self::units(bits), entries);
            }
        }
        let table = ValueTable::new(numbers);
        let entries = (0..numbers.len()).map(|index| table.entry(index)).collect();
        (Self::of_table(fraction_bits, table), entries)
    }

    /// Number of fraction bits of the unit of which all values of the matrix are multiples, if there is one.
    pub fn fraction_bits(&self) -> Option<u32> {
        self.fraction_bits
    }

    /// The unit of entries that are in units; 1 for others.
    pub(super) fn unit(&self) -> f64 {
        self.unit
    }

    /// The exponent of a power of two of which all numbers are multiples.
    pub(super) fn least_exponent(&self) -> i32 {
        match self.numbers() {
            None => -self.fraction_bits.unwrap_or(0).cast_signed(),
            Some(numbers) => numbers.iter().map(|(_, number)| number.exponent()).min().unwrap_or(0),
        }
    }

    /// The number of values in the table; `None` if entries are in units.
    pub fn table_len(&self) -> Option<usize> {
        self.table.as_ref().map(|table| table.nearest.len())
    }

    /// The number that an entry holds: exact, but for numbers of biclusters that no f64 holds, of which it is the
    /// nearest f64, infinite beyond the range.
    ///
    /// # Panics
    /// If the table has no such entry.
    #[inline]
    pub fn value(&self, entry: i32) -> f64 {
        match &self.table {
            None => self.unit * f64::from(entry),
            Some(table) => table.index(entry).map(|index| table.nearest[index]).expect("an entry of the table"),
        }
    }

    /// The number that an entry holds.
    ///
    /// # Panics
    /// If the table has no such entry.
    pub fn exact(&self, entry: i32) -> ExactNumber {
        match &self.table {
            None => ExactNumber::of(self.unit * f64::from(entry)),
            Some(table) => table.index(entry).map(|index| table.exact(index)).expect("an entry of the table"),
        }
    }

    /// All numbers of the table, each with the integer of its entries; `None` if entries are in units.
    pub(super) fn numbers(&self) -> Option<Vec<(i32, ExactNumber)>> {
        let table = self.table.as_ref()?;
        Some((0..table.nearest.len()).map(|index| (table.entry(index), table.exact(index))).collect())
    }

    /// True if [`Self::value`] is the number that an entry holds, without rounding.
    ///
    /// # Panics
    /// If the table has no such entry.
    pub fn is_double(&self, entry: i32) -> bool {
        let Some(table) = &self.table else { return true };
        let index = table.index(entry).expect("an entry of the table");
        table.wide.binary_search_by_key(&(index as u32), |(index, _)| *index).is_err()
    }

    /// The integer of an entry for a number; `None` if it is neither a multiple of the unit nor in the table.
    pub(super) fn entry(&self, value: f64) -> Option<i32> {
        match &self.table {
            None => {
                // Exact: the unit is a power of two.
                let units = value / self.unit;
                (units == f64::from(units as i32)).then_some(units as i32)
            }
            Some(table) => {
                let found = table.nearest.binary_search_by(|other| other.total_cmp(&value));
                found.ok().map(|index| table.entry(index))
            }
        }
    }

    /// True if an entry may hold this.
    pub(super) fn has(&self, entry: i32) -> bool {
        entry != 0 && self.table.as_ref().is_none_or(|table| table.index(entry).is_some())
    }

    pub(super) fn table(&self) -> Option<&ValueTable> {
        self.table.as_ref()
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
        let numbers = [-1e300, -0.1, 1e-300, 0.1, 2.0];
        let exact: Vec<ExactNumber> = numbers.iter().map(|&value| ExactNumber::of(value)).collect();
        let (values, entries) = EntryValues::of_numbers(Some(2), &exact);
        assert_eq!(
            (&entries[..], values.table_len(), values.fraction_bits()),
            (&[-2, -1, 1, 2, 3][..], Some(5), Some(2))
        );
        assert_eq!(values, EntryValues::of_table(Some(2), EntryValues::of_doubles(numbers.to_vec()).table.unwrap()));
        for (&entry, &number) in entries.iter().zip(&numbers) {
            assert_eq!((values.value(entry), values.exact(entry)), (number, ExactNumber::of(number)));
            assert_eq!((values.entry(number), values.has(entry)), (Some(entry), true));
        }
        assert_eq!((values.entry(0.2), values.has(0), values.has(4), values.has(-3)), (None, false, false, false));
        let units = [-3.5, 0.25].map(ExactNumber::of);
        assert_eq!(EntryValues::of_numbers(Some(2), &units), (EntryValues::units(2), vec![-14, 1]));
        assert_eq!(EntryValues::units(2).entry(0.3), None);
    }
}
