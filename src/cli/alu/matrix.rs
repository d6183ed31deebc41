//! Dot products in matrix units: `alu dot --unit`.

use std::io::{Read, Write as _};

use refsim::num::matrix::{Element, MatrixUnit, Operand, Value};

use super::stream::{TaskOutput, each_line};
use crate::cli::{Out, OutputError, Verdict};
use crate::error::{InputError, ensure, input_error};

/// A line that was read: the word of the dot product, and what the line expects.
struct Computed<'a> {
    word: u64,
    expected: Option<&'a str>,
}

/// Numbers of a cell, first to last, without separators.
fn codes(cell: &str, element: Element, line: u64) -> Result<Vec<u64>, InputError> {
    let digits = element.digits();
    let found = || cell.chars().take(40).collect::<String>();
    ensure!(
        !cell.is_empty() && cell.len().is_multiple_of(digits) && cell.bytes().all(|byte| byte.is_ascii_hexdigit()),
        "crossbar::alu::hex" => "line {line}: expected numbers of {} of {digits} hexadecimal digits each, found `{}`",
        element.name, found(); help "write the numbers of a one after the other, without separators"
    );
    // Digits are ASCII, as just checked.
    let words = (0..cell.len()).step_by(digits).map(|at| u64::from_str_radix(&cell[at..at + digits], 16).unwrap_or(0));
    let words: Vec<u64> = words.collect();
    let fits = words.iter().all(|&word| u128::from(word) >> element.width() == 0);
    ensure!(fits, "crossbar::alu::width" => "line {line}: expected numbers of {} bits ({}), found `{}`", element.width(),
        element.name, found());
    Ok(words)
}

/// Computes line `number` (from 1); `None` if it is blank, or the header of a table.
fn compute<'a>(
    unit: &MatrixUnit,
    text: &'a str,
    number: u64,
    verify: bool,
) -> Result<Option<Computed<'a>>, InputError> {
    let is_break = |c: char| c == ',' || c.is_ascii_whitespace();
    let cells: Vec<&str> = text.split(is_break).filter(|cell| !cell.is_empty()).collect();
    if cells.is_empty() || number == 1 && cells.last() == Some(&"result") {
        return Ok(None);
    }
    let named = |cell: &str| unit.operands.iter().find(|element| element.name == cell).copied();
    let types = 2 * usize::from(unit.operands.len() > 1);
    let operands = types + 3 + 2 * usize::from(unit.scaling.is_some());
    let count = cells.len();
    // With a result the tables of vectors have a class before it.
    let fits = if verify { (operands + 1..=operands + 2).contains(&count) } else { count == operands };
    let columns = format!(
        "{}a b c{}{}",
        if types > 0 { "ta tb " } else { "" },
        if unit.scaling.is_some() { " sa sb" } else { "" },
        if verify { " result" } else { "" }
    );
    ensure!(fits, "crossbar::alu::fields" => "line {number}: expected {columns}, found {count} fields";
        help "`crossbar units {}` says which types the unit takes", unit.name);
    let expected = if verify { cells.last().copied() } else { None };
    let element = |at: usize| -> Result<Element, InputError> {
        let names: Vec<&str> = unit.operands.iter().map(|element| element.name).collect();
        let wrong = || {
            input_error!("crossbar::alu::type" => "line {number}: expected one of {}, found `{}`",
            names.join(" "), cells[at].chars().take(40).collect::<String>())
        };
        if types == 0 { Ok(unit.operands[0]) } else { named(cells[at]).ok_or_else(wrong) }
    };
    let [ta, tb] = [element(0)?, element(1)?];
    let [a, b] = [codes(cells[types], ta, number)?, codes(cells[types + 1], tb, number)?];
    // One number, in up to a word: bits above those of its type are ignored.
    let word =
        Some(cells[types + 2]).filter(|cell| cell.len() <= 8).and_then(|cell| u64::from_str_radix(cell, 16).ok());
    let c = word.map_or_else(|| codes(cells[types + 2], unit.addend, number), |word| Ok(vec![word]))?;
    ensure!(c.len() == 1, "crossbar::alu::fields" => "line {number}: expected one number c, found {}", c.len());
    let scales = |at: usize| -> Result<Vec<u8>, InputError> {
        let Some(_) = unit.scaling else { return Ok(Vec::new()) };
        Ok(codes(cells[types + at], Element::E4M3, number)?.into_iter().map(|code| code as u8).collect())
    };
    let [sa, sb] = [scales(3)?, scales(4)?];
    let a = Operand { element: ta, codes: &a, scales: &sa };
    let b = Operand { element: tb, codes: &b, scales: &sb };
    unit.check(&a, &b).map_err(|error| input_error!("crossbar::alu::operands" => "line {number}: {error}"))?;
    Ok(Some(Computed { word: unit.dot(a, b, c[0]), expected }))
}

/// Writes the word of every line, or compares it with the result that the line brings; any NaN matches `nan`.
pub(super) fn run(unit: &MatrixUnit, verify: bool, input: impl Read, out: &mut Out) -> miette::Result<Verdict> {
    let json = out.json();
    let digits = unit.result.element().digits();
    let work = |part: &mut TaskOutput, text: &[u8], number: u64| {
        let text = String::from_utf8_lossy(text);
        let Some(Computed { word, expected }) = compute(unit, &text, number, verify)? else { return Ok(()) };
        let word_text = format!("{word:0digits$x}");
        // Writing to memory cannot fail.
        let Some(expected) = expected else {
            let (before, behind) = if json { ("{\"result\":\"", "\"}") } else { ("", "") };
            writeln!(part.text, "{before}{word_text}{behind}").ok();
            return Ok(());
        };
        let is_nan = expected.eq_ignore_ascii_case("nan") && unit.result.element().decode(word) == Value::Nan;
        if is_nan || expected.eq_ignore_ascii_case(&word_text) {
            part.passed += 1;
        } else {
            part.failed += 1;
            writeln!(part.text, "line {number}: {}: expected {expected}, found {word_text}", unit.name).ok();
        }
        Ok(())
    };
    let (mut passed, mut failed) = (0, 0);
    each_line(input, work, |part| {
        if !(json && verify) {
            out.write_all(&part.text).and_then(|()| out.flush()).map_err(OutputError::from)?;
        }
        passed += part.passed;
        failed += part.failed;
        Ok(())
    })?;
    if !verify {
        return Ok(Verdict::Done);
    }
    ensure_some(passed + failed)?;
    if json {
        out.document(&serde_json::json!({ "passed": passed, "failed": failed }))?;
    } else {
        out.line(format_args!("{passed} passed, {failed} failed"))?;
    }
    Ok(Verdict::held(failed == 0))
}

/// A check that checked nothing must not pass.
fn ensure_some(lines: u64) -> Result<(), InputError> {
    ensure!(lines > 0, "crossbar::alu::empty" => "expected at least one line to verify, found none");
    Ok(())
}
