//! Products: by a unit, with or without promotion, and exact.

use rayon::prelude::*;
use refsim::exec::batch::{MatrixColumns, MatrixRows};
use refsim::num::matrix::{Element, MatrixError, MatrixUnit};
use refsim::num::{Format, ops};

use super::operands::MatrixInput;
use crate::io::NumbersOrCodes;

const TASK_ROWS: usize = 8;

/// The operands of a product in the types of a unit.
#[derive(Debug)]
pub struct MatrixOperands {
    pub(super) unit: MatrixUnit,
    pub(super) a: MatrixRows,
    /// Columns of B.
    pub(super) b: MatrixRows,
    /// C, row by row, in the type of the unit; zeros if the product has no C.
    pub(super) c: Vec<u64>,
    /// Numbers of A and B, multiplied by their scales.
    numbers: [Vec<f64>; 2],
}

/// An exact element of D: the sum in two parts, and the sum of the magnitudes of its addends.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct ExactSum {
    high: f64,
    low: f64,
    pub(super) magnitudes: f64,
}

impl ExactSum {
    fn add(&mut self, addend: f64) {
        let sum = self.high + addend;
        let part = sum - self.high;
        // An infinite sum has no rest.
        if sum.is_finite() {
            self.low += (self.high - (sum - part)) + (addend - part);
        }
        self.high = sum;
        self.magnitudes += addend.abs();
    }

    /// Adds what `x * y` loses as one double; only products of fp64 lose something.
    fn add_rest(&mut self, x: f64, y: f64) {
        let product = x * y;
        if product.is_finite() {
            self.low += libm::fma(x, y, -product);
        }
    }

    /// The sum as one double.
    pub(super) fn value(self) -> f64 {
        self.high + self.low
    }

    /// Replaces the sum, and keeps the sum of magnitudes.
    pub(super) fn replaced(self, value: f64) -> Self {
        Self { high: value, low: 0.0, ..self }
    }

    /// A number minus the sum.
    pub(super) fn error(self, found: f64) -> f64 {
        (found - self.high) - self.low
    }
}

impl MatrixOperands {
    /// Quantises A, B and C for a unit; `elements` are the types of A and B, by default the unit's first. Fails if
    /// shapes do not match, or the unit does not accept such operands.
    pub fn new(
        unit: MatrixUnit,
        [a, b]: [&MatrixInput; 2],
        c: Option<&MatrixInput>,
        elements: [Option<Element>; 2],
    ) -> Result<Self, MatrixError> {
        let [[rows, depth], [other, columns]] = [a.shape()?, b.shape()?];
        let wrong = |input: &MatrixInput, expected: String, found: String| {
            Err(MatrixError::new(format!("{}: shape", input.name), expected, found))
        };
        if depth != other {
            return wrong(b, format!("{depth} rows, as A has columns"), format!("[{other}, {columns}]"));
        }
        let [x, y] = elements.map(|element| element.unwrap_or(unit.operands[0]));
        let (a, b) = (a.rows(&unit, x, false)?, b.rows(&unit, y, true)?);
        unit.check(&a.row(0, 0, depth), &b.row(0, 0, depth))?;
        let code = |x: &f64| unit.addend.code(*x).unwrap_or(0);
        let c = match c.map(|c| (c, &c.data, c.shape())) {
            None => vec![0; rows * columns],
            Some((_, NumbersOrCodes::Numbers(array), Ok(shape))) if shape == [rows, columns] => {
                array.values.iter().map(code).collect()
            }
            Some((c, data, _)) => {
                let kind = if matches!(data, NumbersOrCodes::Codes(_)) { "patterns of " } else { "" };
                return wrong(c, format!("numbers of [{rows}, {columns}]"), format!("{kind}{:?}", c.shape()?));
            }
        };
        let numbers = [numbers(&unit, &a), numbers(&unit, &b)];
        Ok(Self { unit, a, b, c, numbers })
    }

    /// Rows and columns of D.
    pub fn shape(&self) -> [usize; 2] {
        [self.a.count(), self.b.count()]
    }

    /// Number of products per element.
    pub fn depth(&self) -> usize {
        self.a.length
    }

    /// D as doubles, which hold each number exactly.
    pub(super) fn product(
        &self,
        unit: &MatrixUnit,
        depth: usize,
        promote: Option<usize>,
    ) -> Result<Vec<f64>, MatrixError> {
        let number = |word| unit.result.element.number(word);
        Ok(self.words(unit, depth, promote)?.into_iter().map(number).collect())
    }

    /// Words of D over the first `depth` products, by a unit that takes the same operands. With `promote`, the partial
    /// sum of every `promote` products is added to a sum in single precision, rounded to nearest even, and the unit
    /// restarts from zero. Fails if the unit does not support the promotion.
    pub fn words(&self, unit: &MatrixUnit, depth: usize, promote: Option<usize>) -> Result<Vec<u64>, MatrixError> {
        let result = unit.result.element;
        let multiple = unit.block.max(self.a.share);
        if let Some(step) = promote {
            let what = format!("promotion of {}", unit.name);
            if result != Element::FP32 {
                return Err(MatrixError::new(what, "results of single precision", result.name));
            }
            if step == 0 || !step.is_multiple_of(multiple) {
                return Err(MatrixError::new(what, format!("a multiple of {multiple}, its block"), step.to_string()));
            }
        }
        let columns = MatrixColumns::new(*unit, &self.b);
        let [height, width] = self.shape();
        let rows: Vec<usize> = (0..height).collect();
        let task = |rows: &[usize]| -> Vec<u64> {
            let range = rows[0]..rows[0] + rows.len();
            let c = &self.c[range.start * width..range.end * width];
            let multiply = |start, depth, c: &[u64]| columns.multiply(&self.a, range.clone(), start, depth, c);
            let Some(step) = promote else { return multiply(0, depth, c) };
            let single = |&word: &u64| Element::FP32.code(unit.addend.number(word)).unwrap_or(0);
            let mut sums: Vec<u64> = c.iter().map(single).collect();
            for start in (0..depth).step_by(step) {
                let parts = multiply(start, step.min(depth - start), &vec![0; c.len()]);
                for (sum, part) in sums.iter_mut().zip(parts) {
                    *sum = ops::add(Format::FP32, *sum as u32, part as u32).bits.into();
                }
            }
            sums
        };
        Ok(rows.par_chunks(TASK_ROWS).flat_map_iter(task).collect())
    }

    /// The exact D for each depth, in two doubles: exact for types without scales of up to five exponent bits, and
    /// otherwise rounded to about 106 bits.
    pub(super) fn exact(&self, depths: &[usize]) -> Vec<Vec<ExactSum>> {
        let elements: Vec<Vec<ExactSum>> =
            (0..self.c.len()).into_par_iter().map(|index| self.exact_element(index, depths)).collect();
        (0..depths.len()).map(|at| elements.iter().map(|sums| sums[at]).collect()).collect()
    }

    /// One element of [`Self::exact`]; depths are ascending.
    pub(super) fn exact_element(&self, index: usize, depths: &[usize]) -> Vec<ExactSum> {
        let (depth, count) = (self.a.length, self.b.count());
        let row = &self.numbers[0][index / count * depth..][..depth];
        let column = &self.numbers[1][index % count * depth..][..depth];
        let mut sum = ExactSum::default();
        sum.add(self.unit.addend.number(self.c[index]));
        let mut start = 0;
        let mut prefix = |&end: &usize| {
            for (&x, &y) in row[start..end].iter().zip(&column[start..end]) {
                sum.add(x * y);
                if self.a.element == Element::FP64 {
                    sum.add_rest(x, y);
                }
            }
            start = end;
            sum
        };
        depths.iter().map(&mut prefix).collect()
    }
}

/// Numbers with their scales.
fn numbers(unit: &MatrixUnit, rows: &MatrixRows) -> Vec<f64> {
    let scale = |index: usize| match unit.scaling {
        None => 1.0,
        Some((share, scale)) => {
            let place = index / rows.length * rows.length.div_ceil(share) + index % rows.length / share;
            scale.number(rows.scales[place].into())
        }
    };
    rows.codes.iter().enumerate().map(|(index, &code)| rows.element.number(code) * scale(index)).collect()
}
