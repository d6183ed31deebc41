//! Lines are read and written in order, and processed in parallel.
//!
//! All lines of one read are processed before the next read, so that a program at the other end of two pipes may send a
//! line and wait for the answer. A file is read in blocks of a mebibyte, and its lines are distributed among the
//! threads.

use std::io::{ErrorKind, Read, Write as _};

use rayon::prelude::*;
use refsim::num::Outcome;
use serde_json::json;

use super::{
    line::{AluLine, LineFormat, digits, push_hex},
    operation::AluUnit,
};
use crate::cli::{Out, OutputError, Verdict};
use crate::error::{InputError, input_error};

/// Number of bytes per read.
const READ: usize = 1 << 20;
const TASK_LINES: usize = 4096;

/// Output for consecutive lines, and the first error, after which no more lines were processed.
#[derive(Default)]
pub(super) struct TaskOutput {
    pub(super) text: Vec<u8>,
    pub(super) passed: u64,
    pub(super) failed: u64,
    error: Option<InputError>,
}

/// Calls `work` on tasks of consecutive lines in parallel, and `take` on their results in order.
fn each_line(
    mut input: impl Read,
    work: impl Fn(&mut TaskOutput, &[u8], u64) -> Result<(), InputError> + Sync,
    mut take: impl FnMut(&TaskOutput) -> miette::Result<()>,
) -> miette::Result<()> {
    let mut buffer: Vec<u8> = Vec::new();
    let mut number = 1;
    loop {
        let held = buffer.len();
        buffer.resize(held + READ, 0);
        let got = match input.read(&mut buffer[held..]) {
            Err(error) if error.kind() == ErrorKind::Interrupted => {
                buffer.truncate(held);
                continue;
            }
            got => got.map_err(|error| {
                InputError::new("crossbar::alu::input", "standard input cannot be read").with_source(error)
            })?,
        };
        buffer.truncate(held + got);
        // The last line of the input may have no line end; any other incomplete line waits for its rest.
        let whole = if got == 0 {
            buffer.len()
        } else {
            // The buffered part has no line end.
            buffer[held..].iter().rposition(|&b| b == b'\n').map_or(0, |end| held + end + 1)
        };
        let lines: Vec<&[u8]> = buffer[..whole].split_inclusive(|&b| b == b'\n').collect();
        let parts: Vec<TaskOutput> = lines
            .par_chunks(TASK_LINES)
            .enumerate()
            .map(|(task, lines)| run_task(lines, number + (task * TASK_LINES) as u64, &work))
            .collect();
        number += lines.len() as u64;
        for mut part in parts {
            take(&part)?;
            if let Some(error) = part.error.take() {
                return Err(error.into());
            }
        }
        if got == 0 {
            return Ok(());
        }
        buffer.drain(..whole);
    }
}

fn run_task(
    lines: &[&[u8]],
    first: u64,
    work: &impl Fn(&mut TaskOutput, &[u8], u64) -> Result<(), InputError>,
) -> TaskOutput {
    let mut part = TaskOutput::default();
    for (line, number) in lines.iter().zip(first..) {
        if let Err(error) = work(&mut part, line, number) {
            part.error = Some(error);
            break;
        }
    }
    part
}

/// Writes the result of every line of operands.
pub(super) fn compute(unit: &AluUnit, flags: bool, input: impl Read, out: &mut Out) -> miette::Result<()> {
    let format = LineFormat::compute(unit);
    let json = out.json();
    let work = |part: &mut TaskOutput, text: &[u8], number: u64| {
        let Some(line) = format.read(text, number)? else { return Ok(()) };
        let outcome = unit.evaluate(line.operands, number - 1);
        if json {
            push_json_result(&mut part.text, unit, flags, outcome);
        } else {
            push_result(&mut part.text, unit, flags, outcome);
        }
        part.text.push(b'\n');
        Ok(())
    };
    written(input, out, work)
}

/// Writes the result of `work` for every line.
pub(super) fn written(
    input: impl Read,
    out: &mut Out,
    work: impl Fn(&mut TaskOutput, &[u8], u64) -> Result<(), InputError> + Sync,
) -> miette::Result<()> {
    each_line(input, work, |part| {
        out.write_all(&part.text).and_then(|()| out.flush()).map_err(OutputError::from)?;
        Ok(())
    })
}

fn push_result(text: &mut Vec<u8>, unit: &AluUnit, flags: bool, outcome: Outcome) {
    push_hex(text, outcome.bits, unit.result_width());
    if flags {
        text.push(b' ');
        push_hex(text, u32::from(outcome.flags.bits()), 8);
    }
}

fn push_json_result(text: &mut Vec<u8>, unit: &AluUnit, flags: bool, outcome: Outcome) {
    text.extend_from_slice(b"{\"result\":\"");
    push_hex(text, outcome.bits, unit.result_width());
    if flags {
        text.extend_from_slice(b"\",\"flags\":\"");
        push_hex(text, u32::from(outcome.flags.bits()), 8);
    }
    text.extend_from_slice(b"\"}");
}

/// Compares the expected results of the lines with ours.
pub(super) fn verify(unit: &AluUnit, flags: bool, input: impl Read, out: &mut Out) -> miette::Result<Verdict> {
    let format = LineFormat::verify(unit, flags);
    let json = out.json();
    let work = |part: &mut TaskOutput, text: &[u8], number: u64| {
        let Some(line) = format.read(text, number)? else { return Ok(()) };
        let outcome = unit.evaluate(line.operands, number - 1);
        if agrees(unit, flags, &line, outcome) {
            part.passed += 1;
        } else {
            part.failed += 1;
            push_mismatch(&mut part.text, unit, flags, &line, outcome, number, json);
        }
        Ok(())
    };
    verified(input, out, work)
}

/// Counts lines that pass and fail in `work`, which writes failing lines: with `--json`, a comma and a document. A
/// closed pipe does not change the verdict.
pub(super) fn verified(
    input: impl Read,
    out: &mut Out,
    work: impl Fn(&mut TaskOutput, &[u8], u64) -> Result<(), InputError> + Sync,
) -> miette::Result<Verdict> {
    out.outlive_reader();
    let json = out.json();
    let (mut passed, mut failed) = (0_u64, 0_u64);
    // JSON is written completely or not at all: the last line may be an error.
    let mut mismatches = Vec::new();
    each_line(input, work, |part| {
        if json {
            mismatches.extend_from_slice(&part.text);
        } else {
            out.write_all(&part.text).map_err(OutputError::from)?;
        }
        passed += part.passed;
        failed += part.failed;
        Ok(())
    })?;
    // A check without any lines must not pass: the generator of the lines may have failed.
    if passed + failed == 0 {
        let empty = input_error!("crossbar::alu::empty" => "expected at least one line to verify, found none";
            help "pipe lines in, as from `testfloat_gen f16_add`");
        return Err(empty.into());
    }
    if json {
        // Every mismatch begins with a comma.
        let list = String::from_utf8_lossy(mismatches.get(1..).unwrap_or_default());
        out.line(format_args!("{{\"mismatches\":[{list}],\"passed\":{passed},\"failed\":{failed}}}"))?;
    } else {
        out.line(format_args!("{passed} passed, {failed} failed"))?;
    }
    Ok(Verdict::held(failed == 0))
}

fn agrees(unit: &AluUnit, flags: bool, line: &AluLine, outcome: Outcome) -> bool {
    let same = outcome.bits == line.result || (unit.is_nan(outcome.bits) && unit.is_nan(line.result));
    same && (!flags || line.flags == Some(outcome.flags.bits()))
}

fn push_mismatch(
    text: &mut Vec<u8>,
    unit: &AluUnit,
    flags: bool,
    line: &AluLine,
    outcome: Outcome,
    number: u64,
    json: bool,
) {
    let operands: Vec<String> =
        line.operands[..unit.op.operands()].iter().map(|&bits| digits(bits, unit.operand_width())).collect();
    let (expected, found) = (digits(line.result, unit.result_width()), digits(outcome.bits, unit.result_width()));
    let (expected_flags, found_flags) =
        (digits(u32::from(line.flags.unwrap_or(0)), 8), digits(u32::from(outcome.flags.bits()), 8));
    if json {
        let mut record = json!({ "line": number, "operands": operands, "expected": expected, "found": found });
        if flags {
            record["expected_flags"] = expected_flags.into();
            record["found_flags"] = found_flags.into();
        }
        text.push(b',');
        text.extend_from_slice(record.to_string().as_bytes());
        return;
    }
    let (expected, found) = if flags {
        (format!("{expected} {expected_flags}"), format!("{found} {found_flags}"))
    } else {
        (expected, found)
    };
    let operands = operands.join(" ");
    // Writing to memory cannot fail.
    writeln!(text, "line {number}: {} {operands}: expected {expected}, found {found}", unit.op.name()).ok();
}
