//! Matrices: numbers that are quantised, or patterns.

use std::path::Path;

use refsim::exec::batch::MatrixRows;
use refsim::num::block::BlockFormat;
use refsim::num::matrix::{Element, MatrixError, MatrixUnit, Value};
use refsim::num::{Encoding, Format, Overflow, ops};

use crate::error::InputError;
use crate::io::{NumberArray, NumbersOrCodes, load_numbers_or_codes};
use crate::study::error::library_errors;

/// Longest file that is read, in bytes (1 GiB).
const MAX_BYTES: u64 = 1 << 30;

library_errors! {
    MatrixError;
}

/// A matrix, as read.
#[derive(Clone, Debug, PartialEq)]
pub struct MatrixInput {
    /// Its name in messages.
    pub name: String,
    /// Numbers or patterns, row by row.
    pub data: NumbersOrCodes,
}

impl MatrixInput {
    /// Reads a matrix from an array of NumPy's.
    ///
    /// # Errors
    /// If the file cannot be read, is longer than 1 GiB, or holds no array of two axes.
    pub fn load(path: &Path) -> Result<Self, InputError> {
        let made = Self { name: path.display().to_string(), data: load_numbers_or_codes(path, "matrix", MAX_BYTES)? };
        made.shape()
            .map(|_| made.clone())
            .map_err(|error| InputError::new("crossbar::matmul::shape", error.to_string()))
    }

    /// Rows and columns.
    ///
    /// # Errors
    /// If there are not two axes.
    pub fn shape(&self) -> Result<[usize; 2], MatrixError> {
        let shape = match &self.data {
            NumbersOrCodes::Numbers(array) => &array.shape,
            NumbersOrCodes::Codes(array) => &array.shape,
        };
        let wrong = || MatrixError::new(format!("{}: shape", self.name), "two axes", format!("{shape:?}"));
        <[usize; 2]>::try_from(&shape[..]).map_err(|_| wrong())
    }

    /// The matrix with rows and columns exchanged.
    pub(super) fn transposed(&self) -> Result<Self, MatrixError> {
        let [rows, columns] = self.shape()?;
        let data = match &self.data {
            NumbersOrCodes::Numbers(array) => NumbersOrCodes::Numbers(transposed(array, rows, columns)),
            NumbersOrCodes::Codes(array) => NumbersOrCodes::Codes(transposed(array, rows, columns)),
        };
        Ok(Self { name: self.name.clone(), data })
    }

    /// The rows as a unit takes them. Numbers are quantised to nearest even, types of up to 8 bits saturate; blocks of
    /// the MX formats get their scales by OCP's rule.
    pub(super) fn rows(&self, unit: &MatrixUnit, element: Element) -> Result<MatrixRows, MatrixError> {
        let length = self.shape()?[1];
        let wrong = |expected: &str, found: String| MatrixError::new(self.name.clone(), expected, found);
        let share = unit.scaling.map_or(1, |scaling| scaling.block);
        let rows = MatrixRows { element, length, codes: Vec::new(), scales: Vec::new(), share };
        match (&self.data, unit.scaling) {
            (NumbersOrCodes::Codes(_), Some(_)) => Err(wrong(
                "numbers, which get scales",
                "patterns without scales (`crossbar alu dot` takes both)".into(),
            )),
            (_, Some(scaling)) if scaling.is_e4m3 => {
                Err(wrong("a unit whose scales are powers of two", format!("{} (use `crossbar alu dot`)", unit.name)))
            }
            (NumbersOrCodes::Codes(array), None) => {
                let is_wide = |code: &&u64| u128::from(**code) >> element.width() != 0;
                match array.values.iter().find(is_wide) {
                    Some(code) => Err(wrong(&format!("patterns of {}", element.name), format!("{code:x}"))),
                    None => Ok(MatrixRows { codes: array.values.clone(), ..rows }),
                }
            }
            (NumbersOrCodes::Numbers(array), None) => {
                let codes: Option<Vec<u64>> = array.values.iter().map(|&x| code(element, x)).collect();
                let codes = codes.ok_or_else(|| wrong(&format!("numbers, for {}", element.name), "NaN".into()))?;
                Ok(MatrixRows { codes, ..rows })
            }
            (NumbersOrCodes::Numbers(array), Some(_)) => {
                let block = BlockFormat::ALL.into_iter().find(|block| format(element) == Some(block.element()));
                let block = block.ok_or_else(|| wrong("a type of the MX formats", element.name.into()))?;
                let mut rows = rows;
                for numbers in array.values.chunks(length).flat_map(|row| row.chunks(share)) {
                    let words: Vec<u32> = numbers.iter().map(|x| x.to_bits()).collect();
                    let made = block.quantize(&Format::FP32, &words);
                    rows.codes.extend(made.elements.into_iter().map(u64::from));
                    rows.scales.push(made.scale as u8);
                }
                Ok(rows)
            }
        }
    }
}

fn transposed<T: Copy>(array: &NumberArray<T>, rows: usize, columns: usize) -> NumberArray<T> {
    let values =
        (0..columns).flat_map(|column| (0..rows).map(move |row| array.values[row * columns + column])).collect();
    NumberArray { shape: vec![columns, rows], values }
}

/// The number format of a type, saturating if it has up to 8 bits.
fn format(element: Element) -> Option<Format> {
    let format =
        Format::float(element.exponent_bits as u8, element.fraction_bits as u8)?.with_encoding(element.encoding);
    let is_short = element.width() <= 8;
    Some(if is_short { format.with_overflow(Overflow::Saturate) } else { format })
}

/// The pattern of a number, rounded to nearest even; `None` of NaN where a type has none.
pub(super) fn code(element: Element, number: f32) -> Option<u64> {
    let Some(format) = format(element) else { return Some(f64::from(number).to_bits()) };
    if number.is_nan() && element.encoding == Encoding::Finite && element.width() <= 6 {
        return None;
    }
    Some(u64::from(ops::convert(&Format::FP32, format, number.to_bits()).bits) << element.ignored_bits)
}

/// The number of a pattern; exact but in its NaN bits.
pub(super) fn number(element: Element, code: u64) -> f64 {
    match element.decode(code) {
        Value::Finite(x) => {
            let size = x.magnitude as f64 * power(x.exponent) * power(-x.fraction.cast_signed());
            if x.negative { -size } else { size }
        }
        Value::Infinite { negative: false } => f64::INFINITY,
        Value::Infinite { negative: true } => f64::NEG_INFINITY,
        Value::Nan => f64::NAN,
    }
}

/// 2 to an exponent of a normal double.
pub(super) fn power(exponent: i32) -> f64 {
    f64::from_bits(((exponent.clamp(-1022, 1023) + 1023) as u64) << 52)
}
