//! Parts shared by both languages: the statement loop, masks, swizzles, numbers, constants in braces, and mnemonics.

use super::super::error::{AssembleErrors, ErrorKind, Parsed, SyntaxError, quote};
use super::super::{letters, number};
use crate::asm::cursor::Cursor;
use crate::asm::lexer::{Token, TokenKind};
use crate::isa::{
    Destination, Mask, Opcode, Precision, Register, RegisterFile, Span, Spelling, Swizzle, TextureTarget,
};

/// Parses a program's statements and `END`. Errors are recorded, and parsing continues with the next statement.
pub(super) fn statements<'a, P>(
    parser: &mut P,
    cursor: fn(&mut P) -> &mut Cursor<'a>,
    statement: fn(&mut P) -> Parsed<()>,
) -> Option<AssembleErrors> {
    while cursor(parser).goes_on() {
        let token = cursor(parser).peek();
        if token.kind == TokenKind::End {
            let help = "close the program with `END`";
            cursor(parser).record(token.error(ErrorKind::MissingEnd, "`END`", help));
            break;
        }
        if token.text == "END" {
            cursor(parser).next();
            let after = cursor(parser).peek();
            if after.kind != TokenKind::End {
                let help = "only comments may follow `END`";
                cursor(parser).record(after.error(ErrorKind::UnexpectedToken, "the end of the text", help));
            }
            break;
        }
        if let Err(error) = statement(parser) {
            cursor(parser).record(error);
            cursor(parser).skip_statement();
        }
    }
    cursor(parser).finish()
}

/// Component numbers of letters, which OpenGL requires in lower case.
fn components(letters: &str) -> Option<Vec<u8>> {
    letters::components(letters).filter(|_| letters.bytes().all(|letter| letter.is_ascii_lowercase()))
}

/// Parses `.xyz` after a destination; all components by default.
fn mask(cursor: &mut Cursor<'_>) -> Parsed<Mask> {
    if !cursor.accept_mark(".") {
        return Ok(Mask::ALL);
    }
    let token = cursor.next();
    components(token.text).and_then(|all| letters::mask_of(&all)).ok_or_else(|| {
        token.error(
            ErrorKind::Mask,
            "components in the order xyzw, each once",
            "write `.x`, `.xyz` or `.yw`, for example",
        )
    })
}

/// Parses the rest of a destination whose register, starting at `start`, was parsed.
pub(super) fn destination(
    cursor: &mut Cursor<'_>,
    register: Register,
    start: u32,
    saturate: bool,
) -> Parsed<Destination> {
    let mut mask = mask(cursor)?;
    if register.file == RegisterFile::DepthOut && mask.contains(2) {
        // Depth is written through the third component only.
        mask = Mask(0b0100);
    }
    let span = Span::new(start, cursor.last_end());
    Ok(Destination { saturate, ..Destination::new(register, mask, span) })
}

/// Parses `.x` or `.xyzw` after a source; the identity by default.
pub(super) fn swizzle(cursor: &mut Cursor<'_>) -> Parsed<Swizzle> {
    if !cursor.accept_mark(".") {
        return Ok(Swizzle::IDENTITY);
    }
    let token = cursor.next();
    match components(token.text).as_deref() {
        Some([one]) => Ok(Swizzle::replicate(*one)),
        Some(&[x, y, z, w]) => Ok(Swizzle([x, y, z, w])),
        _ => Err(token.error(ErrorKind::Swizzle, "one or four of xyzw", "write `.x` or `.xxyz`, for example")),
    }
}

/// Parses an integer up to `most`.
pub(super) fn index(cursor: &mut Cursor<'_>, most: u16) -> Parsed<u16> {
    let token = cursor.next();
    let number = if token.kind == TokenKind::Number { token.text.parse().ok() } else { None };
    number.filter(|&n| n <= most).ok_or_else(|| register_number(token, most))
}

fn register_number(token: Token<'_>, most: u16) -> SyntaxError {
    token.error(ErrorKind::RegisterNumber, format!("a number from 0 to {most}"), "count from 0")
}

/// The number after a prefix, as in `R12`; `None` if the word has another form.
pub(super) fn numbered(token: Token<'_>, prefix: &str, most: u16) -> Option<Parsed<u16>> {
    let digits = token.text.strip_prefix(prefix)?;
    if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_digit()) {
        return None;
    }
    Some(digits.parse().ok().filter(|&n| n <= most).ok_or_else(|| register_number(token, most)))
}

/// Consumes an optional sign; returns `true` for a minus.
pub(super) fn sign(cursor: &mut Cursor<'_>) -> bool {
    let negative = cursor.accept_mark("-");
    if !negative {
        cursor.accept_mark("+");
    }
    negative
}

/// Parses a number with optional sign, as single-precision bits.
fn value(cursor: &mut Cursor<'_>) -> Parsed<u32> {
    let negative = sign(cursor);
    let token = cursor.peek();
    if token.kind != TokenKind::Number {
        return Err(token.error(ErrorKind::MalformedValue, "a number", "write `1`, `-0.5` or `2.5e-3`"));
    }
    cursor.next();
    let bits = number::opengl_float(token.text, token.span)?;
    Ok(if negative { bits ^ 0x8000_0000 } else { bits })
}

/// Parses a constant: `{x, y, z, w}`, with missing components from (0, 0, 0, 1), or one number for all components.
pub(super) fn constant(cursor: &mut Cursor<'_>) -> Parsed<[u32; 4]> {
    if !cursor.accept_mark("{") {
        return Ok([value(cursor)?; 4]);
    }
    let mut all = [0, 0, 0, 0x3f80_0000];
    for (i, slot) in all.iter_mut().enumerate() {
        if i > 0 && !cursor.accept_mark(",") {
            break;
        }
        *slot = value(cursor)?;
    }
    cursor.expect("}", "a constant has one to four numbers between braces")?;
    Ok(all)
}

pub(super) fn target(cursor: &mut Cursor<'_>) -> Parsed<TextureTarget> {
    let token = cursor.next();
    token.text.parse().map_err(|_| {
        let names = TextureTarget::ALL.map(TextureTarget::name).join(", ");
        token.error(
            ErrorKind::UnknownUsage,
            format!("one of {names}"),
            "the kind of texture comes last, after the image unit",
        )
    })
}

pub(super) struct Mnemonic {
    pub(super) spelling: &'static Spelling,
    pub(super) precision: Option<Precision>,
    pub(super) updates: bool,
    pub(super) saturate: bool,
}

/// Parses a mnemonic, with the suffixes of `!!FP1.0` if `suffixes`.
pub(super) fn mnemonic(token: Token<'_>, suffixes: bool) -> Parsed<Mnemonic> {
    let (name, saturate) = match token.text.strip_suffix("_SAT") {
        Some(name) => (name, true),
        None => (token.text, false),
    };
    let split = |spelling: &'static Spelling| {
        let mut rest = name.strip_prefix(spelling.name)?;
        let precision = Precision::ALL.into_iter().find(|p| suffixes && rest.starts_with(p.letter()));
        rest = if precision.is_some() { &rest[1..] } else { rest };
        let updates = suffixes && rest == "C";
        (updates || rest.is_empty()).then_some(Mnemonic { spelling, precision, updates, saturate })
    };
    // `EX2R` is `EX2` with a suffix; the longest matching name wins. `KIL` has no result to saturate.
    let best = Spelling::ALL.iter().filter_map(split).max_by_key(|m| m.spelling.name.len());
    let best = best.filter(|m| !(m.saturate && m.spelling.opcode == Opcode::Kil));
    best.ok_or_else(|| {
        let close = Spelling::ALL
            .iter()
            .find(|s| token.text.len() >= 2 && s.name.starts_with(&token.text[..first(token.text)]));
        let help = close.map_or("see the extension's table of instructions".to_owned(), |s| format!("try {}", s.name));
        SyntaxError::new(ErrorKind::UnknownOpcode, token.span, "an instruction", quote(token.text), help)
    })
}

/// Byte length of the first two characters.
fn first(text: &str) -> usize {
    text.char_indices().nth(2).map_or(text.len(), |(at, _)| at)
}
