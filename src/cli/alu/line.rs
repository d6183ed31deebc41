//! TestFloat's line format.

use miette::Diagnostic;

use super::operation::Unit;

/// The most fields of a good line: three operands, a result and flags.
const MAX_FIELDS: usize = 5;

/// A line that cannot be read. Lines count from 1.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error, Diagnostic)]
pub(super) enum LineError {
    #[error("line {line}: expected {expected}, found {found} {}", if *found == 1 { "field" } else { "fields" })]
    #[diagnostic(code(crossbar::alu::fields), help("write the fields of one operation on one line, parted by blanks"))]
    Count { line: u64, expected: String, found: usize },
    #[error("line {line}: expected hexadecimal digits, found `{found}`")]
    #[diagnostic(
        code(crossbar::alu::hex),
        help("write bit patterns as TestFloat does, without `0x`: `3C00` for example")
    )]
    Hex { line: u64, found: String },
    #[error("line {line}: expected at most {digits} hexadecimal digits ({width} bits), found `{found}`")]
    #[diagnostic(code(crossbar::alu::width), help("check that `--format` is the format of the lines"))]
    Width { line: u64, width: u32, digits: u32, found: String },
}

/// How the fields of a line are read.
#[derive(Clone, Copy, Debug)]
pub(super) struct LineFormat {
    operands: usize,
    operand_width: u32,
    result_width: u32,
    /// How many fields may follow the operands, least and most.
    after: (usize, usize),
}

/// A line that was read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct AluLine {
    /// The operands; those that the operation does not take are 0.
    pub(super) operands: [u32; 3],
    /// The expected result, where the format has one.
    pub(super) result: u32,
    /// The expected flags, where the line has them.
    pub(super) flags: Option<u8>,
}

impl LineFormat {
    /// Operands alone.
    pub(super) const fn compute(unit: &Unit) -> Self {
        Self {
            operands: unit.op.operands(),
            operand_width: unit.operand_width(),
            result_width: unit.result_width(),
            after: (0, 0),
        }
    }

    /// Operands, result and flags; without `flags` the last may be missing.
    pub(super) const fn verify(unit: &Unit, flags: bool) -> Self {
        let mut format = Self::compute(unit);
        format.after = if flags { (2, 2) } else { (1, 2) };
        format
    }

    /// Reads line `number` (from 1); `None` if it is blank.
    pub(super) fn read(&self, text: &[u8], number: u64) -> Result<Option<AluLine>, LineError> {
        let mut fields = [&text[..0]; MAX_FIELDS];
        let mut count = 0;
        for field in text.split(u8::is_ascii_whitespace).filter(|field| !field.is_empty()) {
            if let Some(place) = fields.get_mut(count) {
                *place = field;
            }
            count += 1;
        }
        if count == 0 {
            return Ok(None);
        }
        let (least, most) = (self.operands + self.after.0, self.operands + self.after.1);
        if count < least || count > most {
            return Err(LineError::Count { line: number, expected: self.expectation(), found: count });
        }
        let mut line = AluLine { operands: [0; 3], result: 0, flags: None };
        for (operand, field) in line.operands.iter_mut().zip(&fields[..self.operands]) {
            *operand = hex(field, self.operand_width, number)?;
        }
        if count > self.operands {
            line.result = hex(fields[self.operands], self.result_width, number)?;
        }
        if count > self.operands + 1 {
            // Eight bits fit a byte.
            line.flags = Some(hex(fields[self.operands + 1], 8, number)? as u8);
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
            _ => format!("{operands}, result and perhaps flags"),
        }
    }
}

/// The number that the digits of `field` write, if it has at most `width` bits.
pub(super) fn hex(field: &[u8], width: u32, line: u64) -> Result<u32, LineError> {
    let found = || String::from_utf8_lossy(field).chars().take(40).collect();
    let mut value = 0_u64;
    for &byte in field {
        let digit = match byte {
            b'0'..=b'9' => byte - b'0',
            b'A'..=b'F' => byte - b'A' + 10,
            b'a'..=b'f' => byte - b'a' + 10,
            _ => return Err(LineError::Hex { line, found: found() }),
        };
        // Kept below 2^36 so that no number of digits overflows.
        value = (value << 4 | u64::from(digit)).min(1 << 32);
    }
    let digits = width.div_ceil(4);
    if field.len() > digits as usize || value >> width != 0 {
        return Err(LineError::Width { line, width, digits, found: found() });
    }
    // At most 32 bits, as just checked.
    Ok(value as u32)
}

/// Appends `value` in as many digits as `width` bits need.
pub(super) fn push_hex(text: &mut Vec<u8>, value: u32, width: u32) {
    for place in (0..width.div_ceil(4)).rev() {
        text.push(b"0123456789ABCDEF"[(value >> (4 * place) & 15) as usize]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ADD: LineFormat = LineFormat { operands: 2, operand_width: 6, result_width: 6, after: (0, 0) };

    #[test]
    fn good_lines() {
        let line = |text: &str| ADD.read(text.as_bytes(), 1).map(|line| line.map(|line| line.operands));
        assert_eq!(line("3f 1"), Ok(Some([0x3f, 1, 0])));
        assert_eq!(line("  0A\t2B \r"), Ok(Some([0x0a, 0x2b, 0])));
        assert_eq!(line(" \r"), Ok(None));
        assert_eq!(line(""), Ok(None));
    }

    #[test]
    fn bad_lines() {
        let error = |text: &[u8]| ADD.read(text, 7).expect_err("a bad line").to_string();
        assert_eq!(error(b"1"), "line 7: expected 2 operands, found 1 field");
        assert_eq!(error(b"1 2 3 4 5 6 7"), "line 7: expected 2 operands, found 7 fields");
        assert_eq!(error(b"1 0x2"), "line 7: expected hexadecimal digits, found `0x2`");
        assert_eq!(error(b"40 1"), "line 7: expected at most 2 hexadecimal digits (6 bits), found `40`");
        assert_eq!(error(b"001 1"), "line 7: expected at most 2 hexadecimal digits (6 bits), found `001`");
        assert!(error(&[0xff, b' ', b'1']).contains("hexadecimal"), "bytes that are no text");
        assert!(error(&[b'F'; 4000]).len() < 200, "a long line is not echoed whole");
    }

    #[test]
    fn the_widest_format_fits() {
        let format = LineFormat { operands: 1, operand_width: 32, result_width: 32, after: (2, 2) };
        let line = format.read(b"FFFFFFFF 80000000 1F", 1);
        assert_eq!(line, Ok(Some(AluLine { operands: [u32::MAX, 0, 0], result: 0x8000_0000, flags: Some(0x1f) })));
        assert!(format.read(b"1FFFFFFFF 0 0", 1).is_err(), "33 bits");
    }

    #[test]
    fn hex_has_the_width_of_the_format() {
        let mut text = Vec::new();
        push_hex(&mut text, 0x2b, 6);
        push_hex(&mut text, 1, 1);
        push_hex(&mut text, 0xabc, 17);
        assert_eq!(text, b"2B100ABC");
    }
}
