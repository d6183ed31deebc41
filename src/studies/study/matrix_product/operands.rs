//! Matrices of numbers, which are quantised, or of bit patterns.

use std::path::Path;

use refsim::exec::batch::MatrixRows;
use refsim::num::block::BlockFormat;
use refsim::num::matrix::{Element, MatrixError, MatrixUnit};

use crate::error::InputError;
use crate::io::{NumbersOrCodes, load_numbers_or_codes};
use crate::study::error::library_errors;

/// Longest file that is read, in bytes (1 GiB).
const MAX_BYTES: u64 = 1 << 30;

library_errors! {
    MatrixError;
}

/// A matrix, as read.
#[derive(Clone, Debug, PartialEq)]
pub struct MatrixInput {
    /// Name in messages.
    pub name: String,
    /// Numbers or bit patterns, row by row.
    pub data: NumbersOrCodes,
}

impl MatrixInput {
    /// Reads a matrix from a NumPy file. Fails if the file cannot be read, is longer than 1 GiB, or does not hold a
    /// two-dimensional array.
    pub fn load(path: &Path) -> Result<Self, InputError> {
        let made = Self { name: path.display().to_string(), data: load_numbers_or_codes(path, "matrix", MAX_BYTES)? };
        match made.shape() {
            Ok(_) => Ok(made),
            Err(error) => Err(InputError::new("crossbar::matmul::shape", error.to_string())
                .with_help("a vector is a matrix of one row, a.reshape(1, -1), or of one column, b.reshape(-1, 1)")),
        }
    }

    /// Number of rows and columns. Fails if the array is not two-dimensional, or an axis is empty.
    pub fn shape(&self) -> Result<[usize; 2], MatrixError> {
        let shape = match &self.data {
            NumbersOrCodes::Numbers(array) => &array.shape,
            NumbersOrCodes::Codes(array) => &array.shape,
        };
        let made = <[usize; 2]>::try_from(&shape[..]).ok().filter(|shape| !shape.contains(&0));
        let wrong = || {
            MatrixError::new(
                format!("{}: shape", self.name),
                "two axes with at least one element each",
                format!("{shape:?}"),
            )
        };
        made.ok_or_else(wrong)
    }

    /// The rows, or the columns, in a unit's types. Numbers are quantised to nearest even; types of up to 8 bits
    /// saturate; blocks of the MX formats get their scales by OCP's rule.
    pub(super) fn rows(&self, unit: &MatrixUnit, element: Element, columns: bool) -> Result<MatrixRows, MatrixError> {
        let [height, width] = self.shape()?;
        let (count, length) = if columns { (width, height) } else { (height, width) };
        let place = |index: usize| if columns { index % length * width + index / length } else { index };
        let wrong = |expected: &str, found: String| MatrixError::new(self.name.clone(), expected, found);
        let share = unit.scaling.map_or(1, |(share, _)| share);
        let mut rows = MatrixRows { element, length, codes: Vec::new(), scales: Vec::new(), share };
        match (&self.data, unit.scaling) {
            (NumbersOrCodes::Codes(_), Some(_)) => {
                let found = "patterns without scales (`crossbar alu dot` takes both)";
                return Err(wrong("numbers, which get scales", found.into()));
            }
            (_, Some((_, Element::UE4M3))) => {
                let found = format!("{} (use `crossbar alu dot`)", unit.name);
                return Err(wrong("a unit whose scales are powers of two", found));
            }
            (NumbersOrCodes::Codes(array), None) => {
                let is_wide = |code: &&u64| u128::from(**code) >> element.width() != 0;
                if let Some(code) = array.values.iter().find(is_wide) {
                    return Err(wrong(&format!("patterns of {}", element.name), format!("{code:x}")));
                }
                rows.codes = (0..count * length).map(|index| array.values[place(index)]).collect();
            }
            (NumbersOrCodes::Numbers(array), None) => {
                let codes = (0..count * length).map(|index| element.code(array.values[place(index)]));
                let nan = || wrong(&format!("numbers, for {} has no NaN", element.name), "NaN".into());
                rows.codes = codes.collect::<Option<_>>().ok_or_else(nan)?;
            }
            (NumbersOrCodes::Numbers(array), Some(_)) => {
                let block = BlockFormat::ALL.into_iter().find(|block| {
                    element.format.is_some_and(|format| {
                        (format.kind, format.encoding) == (block.element().kind, block.element().encoding)
                    })
                });
                let block = block.ok_or_else(|| wrong("a type of the MX formats", element.name.into()))?;
                let numbers: Vec<f64> = (0..count * length).map(|index| array.values[place(index)]).collect();
                for numbers in numbers.chunks(length).flat_map(|row| row.chunks(share)) {
                    let made = block.quantize_doubles(numbers);
                    rows.codes.extend(made.elements.into_iter().map(u64::from));
                    rows.scales.push(made.scale as u8);
                }
            }
        }
        Ok(rows)
    }
}
