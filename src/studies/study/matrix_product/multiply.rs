//! Products: by a unit, with or without promotion, and exact.

use rayon::prelude::*;
use refsim::exec::batch::{MatrixColumns, MatrixRows};
use refsim::num::matrix::{Element, MatrixError, MatrixUnit, Value};
use refsim::num::{Format, ops};

use super::operands::{MatrixInput, code, number, power};

/// Rows of one task.
const TASK_ROWS: usize = 8;

/// The operands of a product in the types of a unit.
#[derive(Debug)]
pub(super) struct Operands {
    pub(super) unit: MatrixUnit,
    pub(super) a: MatrixRows,
    /// Columns of B.
    pub(super) b: MatrixRows,
    /// C, by rows; zeros without.
    pub(super) c: Vec<f32>,
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
        self.low += (self.high - (sum - part)) + (addend - part);
        self.high = sum;
        self.magnitudes += addend.abs();
    }

    /// The sum, rounded once more.
    pub(super) fn value(self) -> f64 {
        self.high + self.low
    }

    /// Another sum of addends of the same magnitudes.
    pub(super) fn replaced(self, value: f64) -> Self {
        Self { high: value, low: 0.0, ..self }
    }

    /// A number minus the sum.
    pub(super) fn error(self, found: f64) -> f64 {
        (found - self.high) - self.low
    }
}

impl Operands {
    /// Quantises A, B and C for a unit; `elements` are the types of A and B, by default the unit's first.
    pub(super) fn new(
        unit: MatrixUnit,
        [a, b]: [&MatrixInput; 2],
        c: Option<&MatrixInput>,
        elements: [Option<Element>; 2],
    ) -> Result<Self, MatrixError> {
        let [[rows, depth], [other, columns]] = [a.shape()?, b.shape()?];
        if depth != other {
            return Err(MatrixError::new(
                format!("{}: rows", b.name),
                format!("{depth}, columns of A"),
                other.to_string(),
            ));
        }
        let [x, y] = elements.map(|element| element.unwrap_or(unit.operands[0]));
        let (a, b) = (a.rows(&unit, x)?, b.transposed()?.rows(&unit, y)?);
        unit.check(&a.row(0, 0, depth), &b.row(0, 0, depth))?;
        let c = match c.map(|c| (c, &c.data, c.shape())) {
            None => vec![0.0; rows * columns],
            Some((_, crate::io::NumbersOrCodes::Numbers(array), Ok(shape))) if shape == [rows, columns] => {
                array.values.clone()
            }
            Some((c, ..)) => {
                let expected = format!("numbers of the shape [{rows}, {columns}]");
                return Err(MatrixError::new(c.name.clone(), expected, format!("{:?}, or patterns", c.shape()?)));
            }
        };
        Ok(Self { unit, a, b, c })
    }

    /// Columns of D.
    pub(super) fn columns(&self) -> usize {
        self.b.count()
    }

    /// D over the first `depth` products: each number exactly. With `promote`, every so many products are added to a
    /// sum in single precision, rounded to nearest even, and the unit begins again from zero.
    pub(super) fn product(
        &self,
        unit: &MatrixUnit,
        depth: usize,
        promote: Option<usize>,
    ) -> Result<Vec<f64>, MatrixError> {
        let result = unit.result.element();
        if let Some(step) = promote {
            let what = format!("promotion of {}", unit.name);
            if result != Element::FP32 {
                return Err(MatrixError::new(what, "results of single precision", result.name));
            }
            let multiple = unit.block().max(self.a.share);
            if step == 0 || !step.is_multiple_of(multiple) {
                return Err(MatrixError::new(what, format!("a multiple of {multiple}, its block"), step.to_string()));
            }
        }
        let columns = MatrixColumns::new(*unit, &self.b);
        let count = self.columns();
        let rows: Vec<usize> = (0..self.a.count()).collect();
        let task = |rows: &[usize]| -> Vec<f64> {
            let range = rows[0]..rows[0] + rows.len();
            let c = &self.c[range.start * count..range.end * count];
            let multiply = |start, depth, c: &[u64]| columns.multiply(&self.a, range.clone(), start, depth, c);
            let codes = |element| c.iter().map(|&x| code(element, x).unwrap_or(0)).collect::<Vec<u64>>();
            let words = match promote {
                None => multiply(0, depth, &codes(unit.addend)),
                Some(step) => {
                    let mut sums = codes(Element::FP32);
                    for start in (0..depth).step_by(step) {
                        let parts = multiply(start, step.min(depth - start), &vec![0; c.len()]);
                        for (sum, part) in sums.iter_mut().zip(parts) {
                            *sum = ops::add(Format::FP32, *sum as u32, part as u32).bits.into();
                        }
                    }
                    sums
                }
            };
            words.into_iter().map(|word| number(result, word)).collect()
        };
        Ok(rows.par_chunks(TASK_ROWS).flat_map_iter(task).collect())
    }

    /// The exact D over each of some depths. Products of up to 26 bits are exact in a double, and their sums in two
    /// doubles, except for types with the exponents of single precision.
    pub(super) fn exact(&self, depths: &[usize]) -> Vec<Vec<ExactSum>> {
        let [a, b] = [&self.a, &self.b].map(|rows| self.numbers(rows));
        let (depth, count) = (self.a.length, self.columns());
        let element = |index: usize| -> Vec<ExactSum> {
            let (row, column) = (&a[index / count * depth..][..depth], &b[index % count * depth..][..depth]);
            let mut sum = ExactSum::default();
            sum.add(self.c[index].into());
            let mut start = 0;
            let mut prefix = |&end: &usize| {
                row[start..end].iter().zip(&column[start..end]).for_each(|(x, y)| sum.add(x * y));
                start = end;
                sum
            };
            depths.iter().map(&mut prefix).collect()
        };
        let elements: Vec<Vec<ExactSum>> = (0..self.c.len()).into_par_iter().map(element).collect();
        (0..depths.len()).map(|at| elements.iter().map(|sums| sums[at]).collect()).collect()
    }

    /// Numbers with their scales.
    fn numbers(&self, rows: &MatrixRows) -> Vec<f64> {
        let scale = |index: usize| match self.unit.scaling {
            None => 1.0,
            Some(scaling) => {
                let per_row = rows.length.div_ceil(rows.share);
                let place = index / rows.length * per_row + index % rows.length / rows.share;
                match scaling.decode(rows.scales[place]) {
                    Value::Finite(x) => power(x.exponent),
                    _ => f64::NAN,
                }
            }
        };
        rows.codes.iter().enumerate().map(|(index, &code)| number(rows.element, code) * scale(index)).collect()
    }
}
