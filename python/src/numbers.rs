//! Number formats on arrays.

use numpy::ndarray::Dimension as _;
use numpy::{Element, PyReadonlyArrayDyn, PyReadwriteArrayDyn};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use refsim::exec::batch::ArrayOperation;
use refsim::num::{self, DotOrder, Format, FormatError, NumberOperation as Op, Rounding, ops, random_word};

use crate::error::{refused, value_error};
use crate::operand::Operand;
use crate::signals::{fill, fill_quickly};

/// Operations by their names in Python.
const OPERATIONS: [(&str, Op); 16] = [
    ("add", Op::Add),
    ("sub", Op::Sub),
    ("mul", Op::Mul),
    ("div", Op::Div),
    ("mad", Op::Mad),
    ("fma", Op::FusedMad),
    ("minimum", Op::Min),
    ("maximum", Op::Max),
    ("floor", Op::Floor),
    ("frac", Op::Frc),
    ("rcp", Op::Rcp),
    ("rsq", Op::Rsq),
    ("sqrt", Op::Sqrt),
    ("exp2", Op::Exp2),
    ("log2", Op::Log2),
    ("saturate", Op::Saturate),
];

fn parse(text: &str) -> PyResult<Format> {
    text.parse().map_err(|error: FormatError| refused(&error))
}

/// An operation in a format, or rounding alone. It runs in the emulator's vector code if that supports the format, and
/// otherwise number by number, from the definition.
#[derive(Clone)]
enum Computation {
    Rows(Box<ArrayOperation>),
    Single { format: Format, operation: Option<Op>, seed: u64 },
}

impl Computation {
    fn new(format: Format, name: &str, seed: u64) -> PyResult<Self> {
        let operation = match OPERATIONS.iter().find(|(known, _)| *known == name) {
            Some((_, operation)) => Some(*operation),
            None if name == "round" => None,
            None => return Err(value_error(format!("expected an operation, found `{name}`"))),
        };
        let rows = match operation {
            Some(operation) => ArrayOperation::new(format, operation),
            None => ArrayOperation::rounding(format),
        };
        Ok(rows.map_or(Self::Single { format, operation, seed }, |rows| Self::Rows(Box::new(rows))))
    }

    /// Computes results as numbers from operands as numbers.
    fn doubles(&mut self, operands: [&[f64]; 3], out: &mut [f64], start: usize) {
        match self {
            Self::Rows(rows) => rows.doubles(operands, out),
            Self::Single { format, .. } => {
                let format = *format;
                self.each(operands, out, start, |x, own| num::from_f64(own, x).bits, |bits| num::to_f64(&format, bits))
            }
        }
    }

    fn patterns(&mut self, operands: [&[u32]; 3], out: &mut [u32], start: usize) {
        match self {
            Self::Rows(rows) => rows.patterns(operands, out),
            Self::Single { .. } => self.each(operands, out, start, |bits, _| bits, |bits| bits),
        }
    }

    /// Computes from the definition. Under stochastic rounding, operands are rounded to nearest even, and the index of
    /// the result selects the random word.
    fn each<T: Copy + Default, R>(
        &self,
        operands: [&[T]; 3],
        out: &mut [R],
        start: usize,
        read: impl Fn(T, Format) -> u32,
        write: impl Fn(u32) -> R,
    ) {
        let Self::Single { format, operation, seed } = *self else { return };
        for (place, out) in out.iter_mut().enumerate() {
            let (mut own, mut nearest) = (format, format);
            if let Rounding::Stochastic(word) = &mut own.rounding {
                *word = random_word(seed, (start + place) as u64);
                nearest.rounding = Rounding::NearestEven;
            }
            let element =
                |some: &[T]| if some.len() == 1 { some[0] } else { some.get(place).copied().unwrap_or_default() };
            let elements = operands.map(element);
            *out = write(match operation {
                None => read(elements[0], own),
                Some(operation) => {
                    let operands = elements.map(|element| read(element, nearest));
                    operation.evaluate(own, operands).map_or(0, |outcome| outcome.bits)
                }
            });
        }
    }
}

/// Fills the result part by part; `compute` receives parts of the operands and of the result.
fn over<T: Element + Copy + Sync + Send, R: Element + Send, C: Clone + Sync>(
    py: Python<'_>,
    operands: &[PyReadonlyArrayDyn<'_, T>],
    out: &mut PyReadwriteArrayDyn<'_, R>,
    computation: &C,
    compute: impl Fn(&mut C, [&[T]; 3], &mut [R], usize) + Sync,
) -> PyResult<()> {
    let operands: Vec<Operand<'_, T>> = operands.iter().map(Operand::new).collect();
    let out = out.as_slice_mut().map_err(|error| value_error(error.to_string()))?;
    let state = || (computation.clone(), [Vec::new(), Vec::new(), Vec::new()]);
    fill_quickly(py, out, state, |(computation, buffers), start, out| {
        let mut parts: [&[T]; 3] = [&[]; 3];
        for ((part, buffer), operand) in parts.iter_mut().zip(buffers).zip(&operands) {
            *part = operand.part(start, out.len(), buffer);
        }
        compute(computation, parts, out, start);
    })
}

/// Returns `true` if a number is NaN, without a branch per number.
fn has_nan(numbers: &[f64]) -> bool {
    numbers.chunks(1 << 12).any(|some| some.iter().fold(false, |found, x| found | x.is_nan()))
}

/// Rejects NaN operands if the format has no NaN; errors call the operands `x`, `y` and `z`.
fn refuse_nan(format: &Format, operands: &[PyReadonlyArrayDyn<'_, f64>]) -> PyResult<()> {
    if format.canonical_nan().is_some() {
        return Ok(());
    }
    for (name, operand) in ["x", "y", "z"].into_iter().zip(operands) {
        let view = operand.as_array();
        let found = match view.as_slice() {
            Some(all) => has_nan(all),
            None => view.iter().any(|x| x.is_nan()),
        };
        // The search for the index is slow, and only the message needs it.
        if let Some((place, _)) = found.then(|| view.indexed_iter().find(|(_, x)| x.is_nan())).flatten() {
            let place: Vec<String> = place.slice().iter().map(usize::to_string).collect();
            let at = if place.is_empty() { String::new() } else { format!("[{}]", place.join(", ")) };
            return Err(value_error(format!(
                "expected numbers, found NaN in {name}{at}: the format {format} has no NaN"
            )));
        }
    }
    Ok(())
}

/// Computes an operation on numbers, and writes it to `out`.
#[pyfunction]
pub(crate) fn compute(
    py: Python<'_>,
    operation: &str,
    format: &str,
    seed: u64,
    operands: Vec<PyReadonlyArrayDyn<'_, f64>>,
    mut out: PyReadwriteArrayDyn<'_, f64>,
) -> PyResult<()> {
    let format = parse(format)?;
    let computation = Computation::new(format, operation, seed)?;
    refuse_nan(&format, &operands)?;
    over(py, &operands, &mut out, &computation, Computation::doubles)
}

/// Computes an operation on bit patterns, and writes it to `out`.
#[pyfunction]
pub(crate) fn compute_patterns(
    py: Python<'_>,
    operation: &str,
    format: &str,
    seed: u64,
    operands: Vec<PyReadonlyArrayDyn<'_, u32>>,
    mut out: PyReadwriteArrayDyn<'_, u32>,
) -> PyResult<()> {
    let format = parse(format)?;
    let computation = Computation::new(format, operation, seed)?;
    over(py, &operands, &mut out, &computation, Computation::patterns)
}

/// Rounds numbers to bit patterns, and writes them to `out`.
#[pyfunction]
pub(crate) fn to_patterns(
    py: Python<'_>,
    format: &str,
    seed: u64,
    numbers: PyReadonlyArrayDyn<'_, f64>,
    mut out: PyReadwriteArrayDyn<'_, u32>,
) -> PyResult<()> {
    let format = parse(format)?;
    let numbers = [numbers];
    refuse_nan(&format, &numbers)?;
    let rounding = Computation::Single { format, operation: None, seed };
    over(py, &numbers, &mut out, &rounding, |rounding, numbers, out, start| {
        rounding.each(numbers, out, start, |number, own| num::from_f64(own, number).bits, |bits| bits);
    })
}

/// Converts bit patterns to numbers, and writes them to `out`.
#[pyfunction]
pub(crate) fn from_patterns(
    py: Python<'_>,
    format: &str,
    patterns: PyReadonlyArrayDyn<'_, u32>,
    mut out: PyReadwriteArrayDyn<'_, f64>,
) -> PyResult<()> {
    let format = parse(format)?;
    let reading = Computation::Single { format, operation: None, seed: 0 };
    over(py, &[patterns], &mut out, &reading, |reading, patterns, out, start| {
        reading.each(patterns, out, start, |bits, _| bits, |bits| num::to_f64(&format, bits));
    })
}

/// Sums products along rows: `x` and `y` have `terms` numbers for each element of `out`.
#[pyfunction]
pub(crate) fn dot(
    py: Python<'_>,
    formats: (&str, &str),
    order: &str,
    x: PyReadonlyArrayDyn<'_, f64>,
    y: PyReadonlyArrayDyn<'_, f64>,
    mut out: PyReadwriteArrayDyn<'_, f64>,
) -> PyResult<()> {
    let (format, accumulator) = (parse(formats.0)?, parse(formats.1)?);
    if [format, accumulator].iter().any(|format| matches!(format.rounding, Rounding::Stochastic(_))) {
        return Err(value_error("a dot product rounds more than once, and `:rst` has one word for an element"));
    }
    let order = match DotOrder::named(order) {
        Some(DotOrder::Aligned(_)) if accumulator.is_fixed() => {
            return Err(value_error("an aligned sum goes by exponents: expected an accumulator of floats"));
        }
        Some(order) => order,
        None => {
            let expected = "expected the order sequential, tree, exact, or aligned:F with F from 0 to 28";
            return Err(value_error(format!("{expected}, found `{order}`")));
        }
    };
    let operands = [x, y];
    refuse_nan(&format, &operands)?;
    let [x, y] = &operands;
    let rows = |array: &PyReadonlyArrayDyn<'_, f64>| array.as_slice().map(<[f64]>::len).unwrap_or_default();
    let (x, y, lengths) = (x.as_slice(), y.as_slice(), [rows(x), rows(y)]);
    let out = out.as_slice_mut().map_err(|error| value_error(error.to_string()))?;
    let (Ok(x), Ok(y), true) = (x, y, lengths[0] == lengths[1] && lengths[0].is_multiple_of(out.len().max(1))) else {
        return Err(value_error("expected two arrays of the same shape, in C order"));
    };
    let terms = lengths[0] / out.len().max(1);
    let task = ((1 << 16) / terms.max(1)).clamp(1, 1 << 12);
    fill(py, out, (task, 64), Vec::new, |pairs, start, out| {
        for (row, out) in (start..).zip(out) {
            let bits = |some: &[f64], k: usize| num::from_f64(format, some[row * terms + k]).bits;
            pairs.clear();
            pairs.extend((0..terms).map(|k| (bits(x, k), bits(y, k))));
            *out = num::to_f64(&format, ops::dot_accumulated(format, accumulator, order, pairs).bits);
        }
    })
}

/// Facts about a format, by name: its string, its width in bits, its largest and smallest numbers.
#[pyfunction]
pub(crate) fn format_facts<'py>(py: Python<'py>, text: &str) -> PyResult<Bound<'py, PyDict>> {
    let format = parse(text)?;
    let number = |bits: u32| num::to_f64(&format, bits);
    let facts = PyDict::new(py);
    facts.set_item("name", format.to_string())?;
    facts.set_item("bits", format.width())?;
    facts.set_item("is_fixed", format.is_fixed())?;
    facts.set_item("max", number(format.max_finite()))?;
    facts.set_item("min", number(format.min_finite()))?;
    facts.set_item("has_nan", format.canonical_nan().is_some())?;
    facts.set_item("has_infinity", format.infinity(false).is_some())?;
    // Positive patterns are ordered like their numbers, so the first above zero is the smallest number; scales have no
    // zero.
    let smallest = if format.is_signed() { 1 } else { 0 };
    facts.set_item("smallest", number(smallest))?;
    let one = format.one();
    let step = if format.is_fixed() { number(1) } else { number(one + 1) - number(one) };
    facts.set_item("epsilon", step)?;
    facts.set_item("smallest_normal", smallest_normal(&format))?;
    Ok(facts)
}

/// The smallest positive number that is not subnormal.
fn smallest_normal(format: &Format) -> f64 {
    if format.is_fixed() { num::to_f64(format, 1) } else { num::power_of_two(format.exponents().0) }
}
