//! The numbers that the search computes with, as integers that are equal where their numbers are.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use num_bigint::{BigInt, BigUint};

use crate::bi_scale::exact::ExactNumber;
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

/// Any numbers, by the order in which they were met first.
#[derive(Debug)]
pub(super) struct KnownNumbers {
    /// All numbers are multiples of 2^this, and are kept as such.
    exponent: i32,
    numbers: Vec<BigInt>,
    known: BTreeMap<BigInt, i32>,
    drop: BigUint,
}

impl KnownNumbers {
    /// The numbers of a matrix, and its entries by these, row by row.
    pub(super) fn new(matrix: &SparseMatrix, drop: f64) -> (Self, Vec<MatrixEntry>, Vec<usize>) {
        let (mut entries, begins) = matrix.to_rows();
        let mut distinct: Vec<i32> = entries.iter().map(|entry| entry.value).collect();
        distinct.sort_unstable();
        distinct.dedup();
        let exact: Vec<ExactNumber> = distinct.iter().map(|&entry| matrix.values().exact(entry)).collect();
        let exponent = exact.iter().map(ExactNumber::exponent).min().unwrap_or(0);
        let units = |number: &ExactNumber| number.in_units(exponent).expect("a multiple of the finest number");
        let mut known =
            Self { exponent, numbers: Vec::new(), known: BTreeMap::new(), drop: units_below(drop, exponent) };
        known.integer(BigInt::ZERO);
        let integers: Vec<Option<i32>> = exact.iter().map(|number| known.integer(units(number))).collect();
        for entry in &mut entries {
            let at = distinct.binary_search(&entry.value).expect("an entry of the matrix");
            entry.value = integers[at].expect("fewer numbers than integers");
        }
        (known, entries, begins)
    }

    /// The number that an integer stands for.
    pub(super) fn exact(&self, integer: i32) -> ExactNumber {
        ExactNumber::new(self.numbers[integer as usize].clone(), self.exponent)
    }

    fn integer(&mut self, number: BigInt) -> Option<i32> {
        if let Some(&integer) = self.known.get(&number) {
            return Some(integer);
        }
        let integer = i32::try_from(self.numbers.len()).ok()?;
        self.numbers.push(number.clone());
        self.known.insert(number, integer);
        Some(integer)
    }
}

/// The largest multiple of 2^`exponent`, in units of it, that is not above a number; 0 of what is negative or not a
/// number.
fn units_below(number: f64, exponent: i32) -> BigUint {
    let exact = ExactNumber::of(if number > 0.0 { number.min(f64::MAX) } else { 0.0 });
    let (magnitude, shift) = (exact.whole().magnitude(), exact.exponent() - exponent);
    if shift >= 0 { magnitude << shift.unsigned_abs() } else { magnitude >> shift.unsigned_abs() }
}

impl SearchNumbers for KnownNumbers {
    fn difference(&mut self, value: i32, t: i32) -> Option<i32> {
        let difference = &self.numbers[value as usize] - &self.numbers[t as usize];
        self.integer(difference)
    }

    fn order(&self, a: i32, b: i32) -> Ordering {
        self.numbers[a as usize].cmp(&self.numbers[b as usize])
    }

    fn is_dropped(&self, residual: i32) -> bool {
        *self.numbers[residual as usize].magnitude() <= self.drop
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
        let (mut numbers, entries, begins) = KnownNumbers::new(&matrix, 0.75);
        assert_eq!(begins, [0, 1, 3]);
        let [four, minus_three, one] = [0, 1, 2].map(|at: usize| entries[at].value);
        let difference = numbers.difference(one, minus_three);
        assert_eq!((difference, numbers.difference(four, 0)), (Some(four), Some(four)));
        assert_eq!(numbers.difference(one, one), Some(0));
        assert_eq!(numbers.order(minus_three, one), Ordering::Less);
        assert_eq!([four, minus_three, one].map(|integer| numbers.is_dropped(integer)), [false, false, true]);
        assert_eq!(numbers.exact(minus_three), ExactNumber::of(-1.5));
        assert_eq!([0.2, -1.0, f64::NAN].map(|drop| units_below(drop, 0)), [0_u8, 0, 0].map(BigUint::from));
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
