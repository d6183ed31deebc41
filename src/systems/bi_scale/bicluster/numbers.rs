//! The numbers of the search, each represented by an integer; equal numbers have equal integers.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use crate::bi_scale::matrix::{MatrixEntry, SparseMatrix};

/// Maps the integers of a search to the numbers that they represent; 0 represents 0.
pub(super) trait SearchNumbers {
    /// The integer for the difference of two numbers; `None` if no integer is left for it.
    fn difference(&mut self, value: i32, t: i32) -> Option<i32>;

    /// Compares the numbers that two integers represent.
    fn order(&self, a: i32, b: i32) -> Ordering;
}

/// Multiples of the matrix's unit; each integer represents itself.
#[derive(Debug)]
pub(super) struct UnitNumbers;

impl SearchNumbers for UnitNumbers {
    #[inline]
    fn difference(&mut self, value: i32, t: i32) -> Option<i32> {
        value.checked_sub(t)
    }

    #[inline]
    fn order(&self, a: i32, b: i32) -> Ordering {
        a.cmp(&b)
    }
}

/// Arbitrary numbers, indexed in the order of first appearance. A difference is rounded to the nearest f64; it is 0
/// only for equal numbers.
#[derive(Debug, Default)]
pub(super) struct KnownNumbers {
    numbers: Vec<f64>,
    /// The integer of each number, by its bits.
    known: BTreeMap<u64, i32>,
}

impl KnownNumbers {
    /// The distinct numbers of a matrix, and its entries row by row, with indices of numbers as values; `None` if there
    /// are more numbers than integers.
    pub(super) fn new(matrix: &SparseMatrix) -> Option<(Self, Vec<Vec<MatrixEntry>>)> {
        let mut known = Self::default();
        known.integer(0.0);
        let mut rows = matrix.to_rows();
        for entry in rows.iter_mut().flatten() {
            entry.value = known.integer(matrix.value(entry.value))?;
        }
        Some((known, rows))
    }

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
}
