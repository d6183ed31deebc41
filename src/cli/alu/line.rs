//! TestFloat's line format.

use super::operation::AluUnit;
use crate::error::{InputError, ensure, input_error};

/// Maximum number of fields of a valid line: three operands, a result and flags.
const MAX_FIELDS: usize = 5;

/// Error for a line (counted from 1) with a wrong number of fields.
pub(super) fn other_fields(line: u64, expected: &str, found: usize) -> InputError {
    let fields = if found == 1 { "field" } else { "fields" };
    input_error!("crossbar::alu::fields" => "line {line}: expected {expected}, found {found} {fields}";
        help "write the fields of one operation on one line, separated by blanks or commas")
}

/// The fields of a line, separated by blanks or commas.
pub(super) fn fields(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    text.split(|byte| byte.is_ascii_whitespace() || *byte == b',').filter(|field| !field.is_empty())
}

/// Parser of the fields of a line.
#[derive(Clone, Copy, Debug)]
pub(super) struct LineFormat {
    operands: usize,
    operand_width: u32,
    result_width: u32,
    /// Minimum and maximum number of fields after the operands.
    after: (usize, usize),
}

/// A line that was read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct AluLine {
    /// The operands; unused ones are 0.
    pub(super) operands: [u32; 3],
    /// The expected result, if the format has one.
    pub(super) result: u32,
    /// The expected flags, if the line has them.
    pub(super) flags: Option<u8>,
}

impl LineFormat {
    /// Operands only.
    pub(super) const fn compute(unit: &AluUnit) -> Self {
        Self {
            operands: unit.op.operands(),
            operand_width: unit.operand_width(),
            result_width: unit.result_width(),
            after: (0, 0),
        }
    }

    /// Operands, result and flags; without `flags`, the flags may be missing.
    pub(super) const fn verify(unit: &AluUnit, flags: bool) -> Self {
        let mut format = Self::compute(unit);
        format.after = if flags { (2, 2) } else { (1, 2) };
        format
    }

    /// Reads line `number` (from 1); `None` if it is blank.
    pub(super) fn read(&self, text: &[u8], number: u64) -> Result<Option<AluLine>, InputError> {
        let mut found = [&text[..0]; MAX_FIELDS];
        let mut count = 0;
        for field in fields(text) {
            if let Some(place) = found.get_mut(count) {
                *place = field;
            }
            count += 1;
        }
        if count == 0 {
            return Ok(None);
        }
        let (least, most) = (self.operands + self.after.0, self.operands + self.after.1);
        if count < least || count > most {
            return Err(other_fields(number, &self.expectation(), count));
        }
        let mut line = AluLine { operands: [0; 3], result: 0, flags: None };
        for (operand, field) in line.operands.iter_mut().zip(&found[..self.operands]) {
            *operand = hex(field, self.operand_width, number)?;
        }
        if count > self.operands {
            line.result = hex(found[self.operands], self.result_width, number)?;
        }
        if count > self.operands + 1 {
            // Eight bits fit a byte.
            line.flags = Some(hex(found[self.operands + 1], 8, number)? as u8);
        }
        Ok(Some(line))
    }

    fn expectation(&self) -> String {
        let operands = match self.operands {
            1 => "1 operand".to_owned(),
            n => format!("{n} operands"),
        };
        match self.after {
            (0, _) => operands,
            (2, _) => format!("{operands}, result and flags"),
            _ => format!("{operands}, result and optionally flags"),
        }
    }
}

/// Parses hexadecimal digits. Fails if the number has more than `width` bits.
pub(super) fn hex(field: &[u8], width: u32, line: u64) -> Result<u32, InputError> {
    let found = || String::from_utf8_lossy(field).chars().take(40).collect::<String>();
    let mut value = 0_u64;
    for &byte in field {
        let digit = match byte {
            b'0'..=b'9' => byte - b'0',
            b'A'..=b'F' => byte - b'A' + 10,
            b'a'..=b'f' => byte - b'a' + 10,
            _ => {
                return Err(input_error!(
                    "crossbar::alu::hex" => "line {line}: expected hexadecimal digits, found `{}`", found();
                    help "write bit patterns as TestFloat does, without `0x`: `3C00` for example"
                ));
            }
        };
        // Clamped to at most 2^32, so that any number of digits is safe.
        value = (value << 4 | u64::from(digit)).min(1 << 32);
    }
    let digits = width.div_ceil(4);
    ensure!(
        field.len() <= digits as usize && value >> width == 0, "crossbar::alu::width" =>
        "line {line}: expected at most {digits} hexadecimal digits ({width} bits), found `{}`", found();
        help "check that `--format` is the format of the lines"
    );
    // At most 32 bits, as checked above.
    Ok(value as u32)
}

/// `value` in as many digits as `width` bits need.
pub(super) fn digits(value: u32, width: u32) -> String {
    format!("{value:0places$X}", places = width.div_ceil(4) as usize)
}

/// Appends [`digits`], without a string.
pub(super) fn push_hex(text: &mut Vec<u8>, value: u32, width: u32) {
    for place in (0..width.div_ceil(4)).rev() {
        text.push(b"0123456789ABCDEF"[(value >> (4 * place) & 15) as usize]);
    }
}
