//! Matrix units of GPUs.

use crossbar::io::{NumberArray, NumbersOrCodes};
use crossbar::study::matrix_product::{MatrixInput, MatrixOperands};
use numpy::{IntoPyArray, PyArray1, PyReadonlyArray2, PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::prelude::*;
use refsim::num::matrix::{Element, MatrixError, MatrixUnit, Operand, UNITS};

use crate::error::{refused, value_error};
use crate::signals::{aside, fill};

/// Name, chips, types, type of c, products per instruction and per block, kept bits, result, confidence, source.
type Row = (
    &'static str,
    &'static str,
    Vec<&'static str>,
    &'static str,
    usize,
    usize,
    Option<u32>,
    &'static str,
    &'static str,
    &'static str,
);

/// The units, oldest first.
#[pyfunction]
pub(crate) fn units() -> Vec<Row> {
    let row = |unit: &MatrixUnit| {
        let types = unit.operands.iter().map(|element| element.name).collect();
        let (c, result) = (unit.addend.name, unit.result.name);
        (unit.name, unit.chips, types, c, unit.length, unit.block, unit.bits, result, unit.evidence, unit.source)
    };
    UNITS.iter().map(row).collect()
}

/// Numbers, or bit patterns.
#[derive(FromPyObject)]
pub(crate) enum Numbers<'py> {
    Numbers(PyReadonlyArrayDyn<'py, f64>),
    Codes(PyReadonlyArrayDyn<'py, u64>),
}

impl Numbers<'_> {
    fn named(self, name: &str) -> MatrixInput {
        let data = match self {
            Self::Numbers(array) => NumbersOrCodes::Numbers(NumberArray {
                shape: array.shape().to_vec(),
                values: array.as_array().iter().copied().collect(),
            }),
            Self::Codes(array) => NumbersOrCodes::Codes(NumberArray {
                shape: array.shape().to_vec(),
                values: array.as_array().iter().copied().collect(),
            }),
        };
        MatrixInput { name: name.to_owned(), data }
    }

    /// Bit patterns of a type, in C order.
    fn codes(self, name: &str, element: Element) -> PyResult<Vec<u64>> {
        match self.named(name).data {
            NumbersOrCodes::Codes(array) => match array.values.iter().find(|&&x| u128::from(x) >> element.width() != 0)
            {
                Some(x) => Err(value_error(format!("{name}: expected patterns of {}, found {x:#x}", element.name))),
                None => Ok(array.values),
            },
            NumbersOrCodes::Numbers(array) => {
                let codes: Option<Vec<u64>> = array.values.iter().map(|&x| element.code(x)).collect();
                codes.ok_or_else(|| {
                    value_error(format!("{name}: expected numbers, found NaN: {} has none", element.name))
                })
            }
        }
    }
}

/// A unit, and the types of both operands if they are given.
fn unit_with_types(name: &str, types: [Option<String>; 2]) -> PyResult<(MatrixUnit, [Option<Element>; 2])> {
    let unit = MatrixUnit::find(name).map_err(|error| refused(&error))?;
    let element = |wanted: Option<String>| {
        let Some(wanted) = wanted else { return Ok(None) };
        let names: Vec<&str> = unit.operands.iter().map(|element| element.name).collect();
        let found = unit.operands.iter().find(|element| element.name == wanted);
        let what = format!("type of {}", unit.name);
        found.copied().map(Some).ok_or_else(|| refused(&MatrixError::new(what, names.join(" "), wanted)))
    };
    let [a, b] = types;
    Ok((unit, [element(a)?, element(b)?]))
}

/// Words of a result, and their width in bits.
type Words<'py> = (Bound<'py, PyArray1<u64>>, u32);

/// A matrix product, row by row. `bits_promote` has the number of kept bits, which replaces the unit's number, and the
/// number of products between promotions.
#[pyfunction]
pub(crate) fn matmul<'py>(
    py: Python<'py>,
    unit: &str,
    types: [Option<String>; 2],
    a: Numbers<'py>,
    b: Numbers<'py>,
    c: Option<PyReadonlyArrayDyn<'py, f64>>,
    bits_promote: (Option<u32>, Option<usize>),
) -> PyResult<Words<'py>> {
    let (mut unit, elements) = unit_with_types(unit, types)?;
    let (bits, promote) = bits_promote;
    if let Some(kept) = bits {
        let what = format!("bits of {}", unit.name);
        let wrong = || refused(&MatrixError::new(what, "1 to 60, of a unit that keeps bits", kept.to_string()));
        unit = unit.with_bits(kept).ok_or_else(wrong)?;
    }
    let (a, b, c) = (a.named("a"), b.named("b"), c.map(|c| Numbers::Numbers(c).named("c")));
    let words = aside(py, move || {
        let operands = MatrixOperands::new(unit, [&a, &b], c.as_ref(), elements)?;
        operands.words(&unit, operands.depth(), promote)
    })?;
    Ok((words.map_err(|error| refused(&error))?.into_pyarray(py), unit.result.element.width()))
}

/// Dot products of the rows of two arrays.
#[pyfunction]
pub(crate) fn unit_dot<'py>(
    py: Python<'py>,
    unit: &str,
    types: [Option<String>; 2],
    operands: (Numbers<'py>, Numbers<'py>, Numbers<'py>),
    length: usize,
    scales: Option<(PyReadonlyArray2<'py, u8>, PyReadonlyArray2<'py, u8>)>,
) -> PyResult<Words<'py>> {
    let (unit, types) = unit_with_types(unit, types)?;
    let [x, y] = types.map(|element| element.unwrap_or(unit.operands[0]));
    let c = operands.2.codes("c", unit.addend)?;
    let [a, b] = [operands.0.codes("x", x)?, operands.1.codes("y", y)?];
    let per_row = scales.as_ref().map_or([0, 0], |(a, b)| [a.shape()[1], b.shape()[1]]);
    let scales = scales.map(|(a, b)| [a, b].map(|some| some.as_array().iter().copied().collect::<Vec<u8>>()));
    let [sa, sb] = scales.unwrap_or_default();
    let rows = |row: usize| -> [Operand<'_>; 2] {
        let part = |per_row: usize| row * per_row..(row + 1) * per_row;
        let [ka, kb] = per_row.map(part);
        [
            Operand { element: x, codes: &a[part(length)], scales: &sa[ka] },
            Operand { element: y, codes: &b[part(length)], scales: &sb[kb] },
        ]
    };
    let fits = |some: usize, per_row: usize| some == c.len() * per_row;
    if c.is_empty()
        || ![(a.len(), length), (b.len(), length)].iter().all(|(some, per_row)| fits(*some, *per_row))
        || !fits(sa.len(), per_row[0])
        || !fits(sb.len(), per_row[1])
    {
        return Err(value_error("expected rows of the same length, and as many rows of scales"));
    }
    let [first, second] = rows(0);
    unit.check(&first, &second).map_err(|error| refused(&error))?;
    let mut words = vec![0; c.len()];
    fill(
        py,
        &mut words,
        (256, 64),
        || (),
        |(), start, out| {
            for (index, out) in (start..).zip(out) {
                let [first, second] = rows(index);
                *out = unit.dot(first, second, c[index]);
            }
        },
    )?;
    Ok((words.into_pyarray(py), unit.result.element.width()))
}
