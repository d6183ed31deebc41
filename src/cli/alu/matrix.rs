//! Dot products in matrix units: `alu dot --unit`.

use refsim::num::matrix::{Element, MatrixUnit, Operand};
use serde_json::json;

use super::line::{Answer, Asked, other_fields};
use crate::error::{InputError, ensure, input_error};

fn shortened(cell: &str) -> String {
    cell.chars().take(40).collect()
}

/// Numbers in a cell, first to last, without separators.
fn codes(cell: &str, element: Element, line: u64) -> Result<Vec<u64>, InputError> {
    let (digits, name) = (element.digits(), element.name);
    ensure!(
        !cell.is_empty() && cell.len().is_multiple_of(digits) && cell.bytes().all(|byte| byte.is_ascii_hexdigit()),
        "crossbar::alu::hex" => "line {line}: expected {name} numbers of {digits} hexadecimal digits each, found `{}`",
        shortened(cell); help "write the numbers one after the other, without separators"
    );
    // Digits are ASCII, as checked above.
    let words = (0..cell.len()).step_by(digits).map(|at| u64::from_str_radix(&cell[at..at + digits], 16).unwrap_or(0));
    let words: Vec<u64> = words.collect();
    let fits = words.iter().all(|&word| u128::from(word) >> element.width() == 0);
    ensure!(fits, "crossbar::alu::width" => "line {line}: expected numbers of {} bits ({name}), found `{}`",
        element.width(), shortened(cell));
    Ok(words)
}

/// Computes the word of line `number` (counted from 1), and reads its expected result, if any; `None` if the line is
/// blank, or is the header of a table.
fn compute<'a>(
    unit: &MatrixUnit,
    text: &'a str,
    number: u64,
    verify: bool,
) -> Result<Option<(u64, &'a str)>, InputError> {
    let is_break = |c: char| c == ',' || c.is_ascii_whitespace();
    let cells: Vec<&str> = text.split(is_break).filter(|cell| !cell.is_empty()).collect();
    let (count, last) = (cells.len(), cells.last().copied().unwrap_or_default());
    if count == 0 || number == 1 && last == "result" {
        return Ok(None);
    }
    let types = if unit.operands.len() > 1 { 2 } else { 0 };
    let scales = if unit.scaling.is_some() { 2 } else { 0 };
    let operands = types + 3 + scales;
    // In the tables of vectors, a class precedes the result.
    if !(count == operands && !verify || verify && (operands + 1..=operands + 2).contains(&count)) {
        let columns = [&["ta tb"][..types / 2], &["a b c"], &["sa sb"][..scales / 2], &["result"][..verify.into()]];
        return Err(other_fields(number, &columns.concat().join(" "), count));
    }
    let element = |at: usize| -> Result<Element, InputError> {
        let named = unit.operands.iter().find(|element| types == 0 || element.name == cells[at]).copied();
        named.ok_or_else(|| {
            let names: Vec<&str> = unit.operands.iter().map(|element| element.name).collect();
            let (names, found) = (names.join(" "), shortened(cells[at]));
            input_error!("crossbar::alu::type" => "line {number}: expected one of {names}, found `{found}`")
        })
    };
    let [ta, tb] = [element(0)?, element(1)?];
    let [a, b] = [codes(cells[types], ta, number)?, codes(cells[types + 1], tb, number)?];
    // One number. A short type may be stored in a longer word, whose upper bits are ignored.
    let (digits, is_short) = (cells[types + 2].len(), unit.addend.digits() < 8);
    let word = u64::from_str_radix(cells[types + 2], 16).ok().filter(|_| digits == 8 || is_short && digits < 8);
    let c = word.map_or_else(|| codes(cells[types + 2], unit.addend, number), |word| Ok(vec![word]))?;
    ensure!(c.len() == 1, "crossbar::alu::fields" => "line {number}: expected one number c, found {}", c.len());
    let scales = |at: usize| -> Result<Vec<u8>, InputError> {
        let Some((_, scale)) = unit.scaling else { return Ok(Vec::new()) };
        Ok(codes(cells[types + at], scale, number)?.into_iter().map(|code| code as u8).collect())
    };
    let [sa, sb] = [scales(3)?, scales(4)?];
    let a = Operand { element: ta, codes: &a, scales: &sa };
    let b = Operand { element: tb, codes: &b, scales: &sb };
    let (digits, is_nan) = (unit.result.element.digits(), last.eq_ignore_ascii_case("nan"));
    let is_word = last.len() == digits && last.bytes().all(|byte| byte.is_ascii_hexdigit());
    ensure!(!verify || is_nan || is_word,
        "crossbar::alu::hex" => "line {number}: expected a result of {digits} hexadecimal digits or `nan`, found `{}`",
        shortened(last));
    unit.check(&a, &b).map_err(|error| input_error!("crossbar::alu::operands" => "line {number}: {error}"))?;
    Ok(Some((unit.dot(a, b, c[0]), last)))
}

/// Returns the word of line `number`, or compares it with the line's expected result; `nan` matches any NaN.
pub(super) fn answer(unit: &MatrixUnit, text: &[u8], number: u64, asked: Asked) -> Result<Option<Answer>, InputError> {
    let Asked { verify, json, .. } = asked;
    let text = String::from_utf8_lossy(text);
    let Some((word, expected)) = compute(unit, &text, number, verify)? else { return Ok(None) };
    let found = format!("{word:0digits$x}", digits = unit.result.element.digits());
    let is_nan = expected.eq_ignore_ascii_case("nan") && unit.result.element.number(word).is_nan();
    Ok(Some(match (verify, json) {
        (true, _) if is_nan || expected.eq_ignore_ascii_case(&found) => Answer::Passed,
        (false, false) => Answer::Text(found),
        (false, true) => Answer::Text(json!({ "result": found }).to_string()),
        (true, false) => Answer::Text(format!("line {number}: {}: expected {expected}, found {found}", unit.name)),
        (true, true) => Answer::Text(json!({ "line": number, "expected": expected, "found": found }).to_string()),
    }))
}
