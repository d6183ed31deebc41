//! Lines: operands, and with `--verify` the expected result and flags, as TestFloat writes them.

use std::ops::RangeInclusive;

use refsim::num::{Flags, Outcome};
use serde_json::json;

use super::operation::{AluOperation, AluUnit};
use crate::error::{InputError, ensure, input_error};

/// Error for a line (counted from 1) with a wrong number of fields.
pub(super) fn other_fields(line: u64, expected: &str, found: usize) -> InputError {
    let fields = if found == 1 { "field" } else { "fields" };
    input_error!("crossbar::alu::fields" => "line {line}: expected {expected}, found {found} {fields}";
        help "write the fields of one operation on one line, separated by blanks or commas")
}

fn fields(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    text.split(|byte| byte.is_ascii_whitespace() || *byte == b',').filter(|field| !field.is_empty())
}

/// Options for every line: verification, comparison of flags, JSON output.
#[derive(Clone, Copy, Debug)]
pub(super) struct Asked {
    pub(super) verify: bool,
    pub(super) flags: bool,
    pub(super) json: bool,
}

pub(super) enum Answer {
    /// The line has what `--verify` expects.
    Passed,
    /// The result, or the sentence about a mismatch; a JSON object with `--json`.
    Text(String),
}

impl AluUnit {
    /// Computes line `number` (from 1), or compares it with the result that it expects; `None` if it is blank.
    pub(super) fn answer(&self, text: &[u8], number: u64, asked: Asked) -> Result<Option<Answer>, InputError> {
        let fields: Vec<&[u8]> = fields(text).collect();
        let (words, expected) = self.op.words();
        let (after, and): (RangeInclusive<usize>, &str) = match (asked.verify, asked.flags) {
            (false, _) => (0..=0, ""),
            (true, true) => (2..=2, ", result and flags"),
            (true, false) => (1..=2, ", result and optionally flags"),
        };
        let count = fields.len();
        if count == 0 {
            return Ok(None);
        }
        let is_odd = self.op == AluOperation::Dot && count % 2 == 1;
        if is_odd || !(words.start() + after.start()..=words.end() + after.end()).contains(&count) {
            return Err(other_fields(number, &format!("{expected}{and}"), count));
        }
        let (operands, after) = fields.split_at(if asked.verify { *words.end() } else { count });
        let operand = |(at, field): (usize, &&[u8])| hex(field, self.operand_width(at), number);
        let operands: Vec<u32> = operands.iter().enumerate().map(operand).collect::<Result<_, _>>()?;
        let wanted = after.first().map(|field| hex(field, self.result_width(0), number)).transpose()?;
        let wanted_flags = after.get(1).map(|field| hex(field, 8, number)).transpose()?;
        let outcomes = self.evaluate(&operands, number - 1);
        let flags = outcomes.iter().fold(Flags::empty(), |flags, outcome| flags | outcome.flags);
        let flags = u32::from(flags.bits());
        if let Some(wanted) = wanted {
            let bits = outcomes[0].bits;
            let is_same = bits == wanted || (self.is_nan(bits) && self.is_nan(wanted));
            if is_same && (!asked.flags || wanted_flags == Some(flags)) {
                return Ok(Some(Answer::Passed));
            }
            let sides = [(wanted, wanted_flags.unwrap_or_default()), (bits, flags)];
            return Ok(Some(Answer::Text(self.mismatch(&operands, sides, number, asked))));
        }
        let digit = |(at, outcome): (usize, &Outcome)| digits(outcome.bits, self.result_width(at));
        let mut found: Vec<String> = outcomes.iter().enumerate().map(digit).collect();
        let flags = asked.flags.then(|| digits(flags, 8));
        if !asked.json {
            found.extend(flags);
            return Ok(Some(Answer::Text(found.join(" "))));
        }
        let mut record = match (self.op, &found[..]) {
            (AluOperation::Quantize, [scale, elements @ ..]) => json!({ "scale": scale, "elements": elements }),
            (op, results) if op.takes_many() => json!({ "results": results }),
            (_, results) => json!({ "result": results[0] }),
        };
        if let Some(flags) = flags {
            record["flags"] = flags.into();
        }
        Ok(Some(Answer::Text(record.to_string())))
    }

    /// The mismatch of a line; each side is a result and its flags.
    fn mismatch(&self, operands: &[u32], sides: [(u32, u32); 2], number: u64, asked: Asked) -> String {
        let operands: Vec<String> = operands.iter().map(|&bits| digits(bits, self.operand_width(0))).collect();
        let [[expected, expected_flags], [found, found_flags]] =
            sides.map(|(bits, flags)| [digits(bits, self.result_width(0)), digits(flags, 8)]);
        if asked.json {
            let mut record = json!({ "line": number, "operands": operands, "expected": expected, "found": found });
            if asked.flags {
                record["expected_flags"] = expected_flags.into();
                record["found_flags"] = found_flags.into();
            }
            return record.to_string();
        }
        let [expected_flags, found_flags] =
            [expected_flags, found_flags].map(|flags| if asked.flags { format!(" {flags}") } else { String::new() });
        let (name, operands) = (self.op.name(), operands.join(" "));
        format!("line {number}: {name} {operands}: expected {expected}{expected_flags}, found {found}{found_flags}")
    }
}

/// Parses hexadecimal digits. Fails if the number has more than `width` bits.
fn hex(field: &[u8], width: u32, line: u64) -> Result<u32, InputError> {
    let text = String::from_utf8_lossy(field);
    let found = || text.chars().take(40).collect::<String>();
    ensure!(
        field.iter().all(u8::is_ascii_hexdigit), "crossbar::alu::hex" =>
        "line {line}: expected hexadecimal digits, found `{}`", found();
        help "write bit patterns as TestFloat does, without `0x`: `3C00` for example"
    );
    let digits = width.div_ceil(4);
    let value = u32::from_str_radix(&text, 16).ok().filter(|value| u64::from(*value) >> width == 0);
    value.filter(|_| field.len() <= digits as usize).ok_or_else(|| {
        input_error!("crossbar::alu::width" =>
            "line {line}: expected at most {digits} hexadecimal digits ({width} bits), found `{}`", found();
            help "check that `--format` is the format of the numbers in the lines")
    })
}

fn digits(value: u32, width: u32) -> String {
    format!("{value:0places$X}", places = width.div_ceil(4) as usize)
}
