//! Tables of operands and expected results.

use refsim_lanes::num::{Format, NumberOperation, Rounding, Unit};

/// A column's name, and the function that computes its cell from a row.
pub(crate) type Check<'c> = (&'c str, &'c dyn Fn(&Row<'_>) -> String);

pub(crate) struct Row<'t> {
    columns: &'t [&'t str],
    cells: Vec<&'t str>,
}

impl<'t> Row<'t> {
    /// The cell of a column; an empty cell repeats the cell of the column that [`repeated`] names.
    pub(crate) fn cell(&self, column: &str) -> &'t str {
        let index = self.columns.iter().position(|c| *c == column).unwrap_or_else(|| panic!("no column {column}"));
        if self.cells[index].is_empty() { self.cell(&repeated(column)) } else { self.cells[index] }
    }

    pub(crate) fn word(&self, column: &str) -> u32 {
        u32::from_str_radix(self.cell(column), 16).expect("hexadecimal digits")
    }
}

/// The column whose cell an empty cell repeats.
fn repeated(column: &str) -> String {
    let other = [
        ("_nv3x_modern", "_nv3x_legacy"),
        ("_nv3x_legacy", "_nv2x"),
        ("_nv3x", "_nv2x"),
        ("_modern", "_legacy"),
        ("_rz", "_rn"),
        ("_rm", "_rn"),
        ("_rp", "_rn"),
        ("_zw", ""),
    ];
    let found = other.iter().find_map(|(from, to)| column.strip_suffix(from).map(|stem| format!("{stem}{to}")));
    found.unwrap_or_else(|| panic!("column {column} may not be empty"))
}

/// Compares every row of a table with the computed values. The checks are all columns but the first `operands`, in
/// order. Returns the number of rows.
pub(crate) fn check(text: &str, operands: usize, checks: &[Check<'_>]) -> usize {
    let mut lines = text.lines();
    let columns: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let names: Vec<&str> = checks.iter().map(|(name, _)| *name).collect();
    assert_eq!(columns[operands..], names);
    let mut rows = 0;
    for line in lines {
        let row = Row { columns: &columns, cells: line.split(',').collect() };
        assert_eq!(row.cells.len(), columns.len(), "{line}");
        for (name, compute) in checks {
            assert_eq!(compute(&row), row.cell(name), "{name} of {line}");
        }
        rows += 1;
    }
    rows
}

pub(crate) fn digits(word: u32) -> String {
    format!("{word:08x}")
}

/// Single precision computed by a card's unit.
pub(crate) fn format(unit: Unit) -> Format {
    Format::FP32.with_unit(unit)
}

pub(crate) fn evaluate(format: Format, operation: NumberOperation, operands: [u32; 3]) -> u32 {
    operation.evaluate(format, operands).expect("the unit has the operation").bits
}

/// Evaluates an operation on columns of a row.
pub(crate) fn columns<'c>(
    format: Format,
    operation: NumberOperation,
    operands: &'c [&'c str],
) -> impl Fn(&Row<'_>) -> String + 'c {
    move |row| {
        let mut words = [0; 3];
        for (word, name) in words.iter_mut().zip(operands) {
            *word = row.word(name);
        }
        digits(evaluate(format, operation, words))
    }
}

pub(crate) fn unary<'c>(column: &'c str, function: impl Fn(u32) -> u32 + 'c) -> impl Fn(&Row<'_>) -> String + 'c {
    move |row| digits(function(row.word(column)))
}

/// Single precision computed by a card's unit, rounded toward zero.
pub(crate) fn toward_zero(unit: Unit) -> Format {
    format(unit).with_rounding(Rounding::TowardZero)
}
