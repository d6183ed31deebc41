//! Lines are read and written in order, and computed in parallel.
//!
//! All lines of one read are answered before the next read, so that a program at the other end of two pipes may send a
//! line and wait for the answer.

use std::io::{self, BufRead, BufReader, Write as _};

use rayon::prelude::*;

use super::line::{Answer, Asked};
use crate::cli::{Out, OutputError, Verdict};
use crate::error::{InputError, input_error};

const READ: usize = 1 << 20;
/// Minimum number of lines for a task of a thread.
const TASK_LINES: usize = 256;

/// The whole lines of one read, or the last line, which may have no line end; none at the end of the input.
fn lines(input: &mut BufReader<impl io::Read>) -> Result<Vec<Vec<u8>>, InputError> {
    let mut lines = Vec::new();
    while lines.is_empty() || input.buffer().contains(&b'\n') {
        let mut line = Vec::new();
        let read = input.read_until(b'\n', &mut line).map_err(|error| {
            InputError::new("crossbar::alu::input", "standard input cannot be read").with_source(error)
        })?;
        if read == 0 {
            break;
        }
        lines.push(line);
    }
    Ok(lines)
}

/// Writes the answer of `work` for every line of standard input. With `verify`, writes only the mismatches and the
/// counts, and a closed pipe does not change the verdict.
pub(super) fn run(
    Asked { verify, json, .. }: Asked,
    out: &mut Out,
    work: impl Fn(&[u8], u64) -> Result<Option<Answer>, InputError> + Sync,
) -> miette::Result<Verdict> {
    if verify {
        out.outlive_reader();
    }
    let mut input = BufReader::with_capacity(READ, io::stdin().lock());
    let (mut number, mut passed, mut failed) = (1, 0_u64, 0_u64);
    // The JSON of mismatches is written completely or not at all: the last line may be an error.
    let mut mismatches = Vec::new();
    loop {
        let lines = lines(&mut input)?;
        if lines.is_empty() {
            break;
        }
        let lines = lines.par_iter().with_min_len(TASK_LINES).enumerate();
        let answers: Vec<_> = lines.map(|(index, line)| work(line, number + index as u64)).collect();
        number += answers.len() as u64;
        for answer in answers {
            match answer? {
                None => {}
                Some(Answer::Passed) => passed += 1,
                Some(Answer::Text(text)) => {
                    failed += 1;
                    match verify && json {
                        true => mismatches.push(text),
                        false => writeln!(out, "{text}").map_err(OutputError::from)?,
                    }
                }
            }
        }
        out.flush().map_err(OutputError::from)?;
    }
    if !verify {
        return Ok(Verdict::Done);
    }
    // A check without any lines must not pass: the generator of the lines may have failed.
    if passed + failed == 0 {
        let empty = input_error!("crossbar::alu::empty" => "expected at least one line to verify, found none";
            help "pipe lines to the command, for example from `testfloat_gen f16_add`");
        return Err(empty.into());
    }
    if json {
        let list = mismatches.join(",");
        out.line(format_args!("{{\"mismatches\":[{list}],\"passed\":{passed},\"failed\":{failed}}}"))?;
    } else {
        out.line(format_args!("{passed} passed, {failed} failed"))?;
    }
    Ok(Verdict::held(failed == 0))
}
