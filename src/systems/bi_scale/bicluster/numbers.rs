//! The numbers that the search computes with, as integers that are equal where their numbers are.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use crate::bi_scale::matrix::{MatrixEntry, SparseMatrix};

/// Numbers behind the integers of a search; 0 stands for 0.
pub(super) trait SearchNumbers {
    /// The integer for the difference of two numbers; `None` if there is no integer left for it.
    fn difference(&mut self, value: i32, t: i32) -> Option<i32>;

    /// The order of two numbers.
    fn order(&self, a: i32, b: i32) -> Ordering;

    /// True if a residual is small enough to be dropped.
    fn is_dropped(&self, residual: i32) -> bool;
}

/// Whole numbers of the matrix's unit, by themselves.
#[derive(Debug)]
pub(super) struct UnitNumbers {
    /// The largest residual that is dropped.
    drop: u32,
}

impl UnitNumbers {
    /// `drop` in the scale of the matrix.
    pub(super) fn new(drop: f64, fraction_bits: u32) -> Self {
        // Saturates, and takes what is not a number for 0.
        Self { drop: (drop * f64::from(1_u32 << fraction_bits)) as u32 }
    }
}

impl SearchNumbers for UnitNumbers {
    #[inline]
    fn difference(&mut self, value: i32, t: i32) -> Option<i32> {
        value.checked_sub(t)
    }

    #[inline]
    fn order(&self, a: i32, b: i32) -> Ordering {
        a.cmp(&b)
    }

    #[inline]
    fn is_dropped(&self, residual: i32) -> bool {
        residual.unsigned_abs() <= self.drop
    }
}

/// Any numbers, by the order in which they were met first. A difference is rounded to the nearest f64; it is 0 for
/// equal numbers alone.
#[derive(Debug, Default)]
pub(super) struct KnownNumbers {
    numbers: Vec<f64>,
    /// The integer of each number, by its bits.
    known: BTreeMap<u64, i32>,
    drop: f64,
}

impl KnownNumbers {
    /// The numbers of a matrix, and its entries by these, row by row; `None` if there are more numbers than integers.
    pub(super) fn new(matrix: &SparseMatrix, drop: f64) -> Option<(Self, Vec<MatrixEntry>, Vec<usize>)> {
        let mut known = Self { drop, ..Self::default() };
        known.integer(0.0);
        let (mut entries, begins) = matrix.to_rows();
        for entry in &mut entries {
            entry.value = known.integer(matrix.value(entry.value))?;
        }
        Some((known, entries, begins))
    }

    /// The number that an integer stands for.
    pub(super) fn number(&self, integer: i32) -> f64 {
        self.numbers[integer as usize]
    }

    fn integer(&mut self, number: f64) -> Option<i32> {
        if let Some(&integer) = self.known.get(&number.to_bits()) {
            return Some(integer);
        }
        let integer = i32::try_from(self.numbers.len()).ok()?;
        self.numbers.push(number);
        self.known.insert(number.to_bits(), integer);
        Some(integer)
    }
}

impl SearchNumbers for KnownNumbers {
    fn difference(&mut self, value: i32, t: i32) -> Option<i32> {
        let difference = self.number(value) - self.number(t);
        if difference.is_finite() { self.integer(difference) } else { None }
    }

    fn order(&self, a: i32, b: i32) -> Ordering {
        self.number(a).total_cmp(&self.number(b))
    }

    fn is_dropped(&self, residual: i32) -> bool {
        self.number(residual).abs() <= self.drop
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_numbers_have_equal_integers() {
        let mut matrix = SparseMatrix::new(3, 1).unwrap();
        matrix.push_row(&[MatrixEntry { index: 1, value: 4 }]).unwrap();
        matrix.push_row(&[MatrixEntry { index: 0, value: -3 }, MatrixEntry { index: 2, value: 1 }]).unwrap();
        let (mut numbers, entries, begins) = KnownNumbers::new(&matrix, 0.75).unwrap();
        assert_eq!(begins, [0, 1, 3]);
        let [four, minus_three, one] = [0, 1, 2].map(|at: usize| entries[at].value);
        let difference = numbers.difference(one, minus_three);
        assert_eq!((difference, numbers.difference(four, 0)), (Some(four), Some(four)));
        assert_eq!(numbers.difference(one, one), Some(0));
        assert_eq!(numbers.order(minus_three, one), Ordering::Less);
        assert_eq!([four, minus_three, one].map(|integer| numbers.is_dropped(integer)), [false, false, true]);
        assert_eq!(numbers.number(minus_three), -1.5);
        let [largest, least] = [f64::MAX, f64::MIN].map(|number| numbers.integer(number).unwrap());
        assert_eq!(numbers.difference(largest, least), None);
        numbers.drop = f64::NAN;
        assert!(!numbers.is_dropped(one));
    }

    #[test]
    fn units_leave_32_bits_for_the_table() {
        let mut numbers = UnitNumbers::new(0.5, 2);
        assert_eq!((numbers.difference(0, i32::MIN), numbers.difference(7, 9)), (None, Some(-2)));
        assert_eq!([2, 3, -2].map(|residual| numbers.is_dropped(residual)), [true, false, true]);
        assert_eq!([UnitNumbers::new(f64::NAN, 0).drop, UnitNumbers::new(-1.0, 0).drop], [0, 0]);
        assert_eq!(UnitNumbers::new(f64::INFINITY, 3).drop, u32::MAX);
    }
}
