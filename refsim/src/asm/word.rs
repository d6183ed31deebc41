//! Mnemonics with their suffixes, and suggestions for unknown mnemonics.

use super::error::{ErrorKind, SyntaxError, quote};
use super::lexer::Token;
use crate::isa::{Comparison, DestinationRule, OpInfo, Opcode, Span};

#[derive(Clone, Copy, Debug)]
pub(super) struct Mnemonic {
    pub(super) opcode: Opcode,
    pub(super) comparison: Option<Comparison>,
    pub(super) shift: i8,
    pub(super) saturate: bool,
    pub(super) partial_precision: bool,
}

/// Rows of the opcode table with this mnemonic (two for `if` and `break`).
fn rows(base: &str) -> impl Iterator<Item = &'static OpInfo> {
    Opcode::ALL.iter().map(|opcode| opcode.info()).filter(move |info| info.mnemonic.eq_ignore_ascii_case(base))
}

/// The first row of the opcode table for a word, ignoring the word's suffixes.
pub(super) fn row(word: &str) -> Option<&'static OpInfo> {
    rows(base(word)).next()
}

/// The word up to its first underscore.
pub(super) fn base(word: &str) -> &str {
    word.split('_').next().unwrap_or(word)
}

/// Returns `true` if the word can start a statement, with any suffixes.
pub(super) fn starts_statement(word: &str) -> bool {
    let base = base(word);
    is_definition(word) || base.eq_ignore_ascii_case("dcl") || rows(base).next().is_some()
}

/// Returns `true` for `def`, `defi` and `defb`.
pub(super) fn is_definition(word: &str) -> bool {
    ["def", "defi", "defb"].iter().any(|d| word.eq_ignore_ascii_case(d))
}

/// Returns `true` if the word has the form of a version token.
pub(super) fn is_version(word: &str) -> bool {
    let bytes = word.as_bytes();
    bytes.len() > 2
        && (bytes[..2].eq_ignore_ascii_case(b"ps") || bytes[..2].eq_ignore_ascii_case(b"vs"))
        && matches!(bytes[2], b'_' | b'.')
}

/// The suffixes of a word, each with its span including the underscore.
pub(super) fn suffixes<'a>(token: &Token<'a>) -> impl Iterator<Item = (&'a str, Span)> + use<'a> {
    let mut start = token.span.start as usize;
    let mut parts = token.text.split('_');
    start += parts.next().map_or(0, str::len);
    parts.map(move |part| {
        let span = Span::new(start as u32, (start + 1 + part.len()) as u32);
        start += 1 + part.len();
        (part, span)
    })
}

const SHIFTS: [(&str, i8); 6] = [("x2", 1), ("x4", 2), ("x8", 3), ("d2", -1), ("d4", -2), ("d8", -3)];

/// Suffix of a shift, for example `_x2` for 1; empty for 0 and for shifts without a suffix.
pub(super) fn shift_suffix(shift: i8) -> &'static str {
    match shift {
        1 => "_x2",
        2 => "_x4",
        3 => "_x8",
        -1 => "_d2",
        -2 => "_d4",
        -3 => "_d8",
        _ => "",
    }
}

pub(super) fn mnemonic(token: &Token<'_>) -> Result<Mnemonic, SyntaxError> {
    let base = base(token.text);
    let Some(first) = rows(base).next() else {
        return Err(unknown_opcode(token, base));
    };
    let mut mnemonic =
        Mnemonic { opcode: first.opcode, comparison: None, shift: 0, saturate: false, partial_precision: false };
    for (part, span) in suffixes(token) {
        suffix(&mut mnemonic, first.mnemonic, part, span)?;
    }
    let wanted = mnemonic.comparison.is_some();
    match rows(base).find(|info| info.comparison == wanted) {
        Some(info) => mnemonic.opcode = info.opcode,
        None if wanted => {
            return Err(SyntaxError::new(
                ErrorKind::UnknownInstructionModifier,
                token.span,
                format!("`{}` without a comparison", first.mnemonic),
                quote(token.text),
                "only `if`, `break` and `setp` can have a comparison",
            ));
        }
        None => {
            return Err(SyntaxError::new(
                ErrorKind::MissingComparison,
                token.span,
                format!("`{}_` and one of gt lt ge le eq ne", first.mnemonic),
                quote(token.text),
                format!("write `{}_gt`, for example", first.mnemonic),
            ));
        }
    }
    let modified = mnemonic.shift != 0 || mnemonic.saturate || mnemonic.partial_precision;
    if modified && mnemonic.opcode.info().destination == DestinationRule::None {
        return Err(SyntaxError::new(
            ErrorKind::ModifierWithoutDestination,
            token.span,
            format!("`{}` without a modifier", first.mnemonic),
            quote(token.text),
            "shifts, `_sat` and `_pp` modify a result, and this instruction has no result",
        ));
    }
    Ok(mnemonic)
}

fn suffix(m: &mut Mnemonic, base: &str, part: &str, span: Span) -> Result<(), SyntaxError> {
    let lower = part.to_ascii_lowercase();
    let repeated = |what: &str| {
        SyntaxError::new(
            ErrorKind::RepeatedModifier,
            span,
            format!("one {what} at most"),
            format!("a second one, `_{lower}`"),
            format!("drop `_{lower}`"),
        )
    };
    if let Some(&(_, shift)) = SHIFTS.iter().find(|(name, _)| *name == lower) {
        if m.shift != 0 {
            return Err(repeated("of _x2 _x4 _x8 _d2 _d4 _d8"));
        }
        m.shift = shift;
    } else if let Some(comparison) = Comparison::ALL.into_iter().find(|c| c.suffix() == lower) {
        if m.comparison.is_some() {
            return Err(repeated("comparison"));
        }
        m.comparison = Some(comparison);
    } else if lower == "sat" {
        if m.saturate {
            return Err(repeated("`_sat`"));
        }
        m.saturate = true;
    } else if lower == "pp" {
        if m.partial_precision {
            return Err(repeated("`_pp`"));
        }
        m.partial_precision = true;
    } else {
        let help = match lower.as_str() {
            "centroid" => "`_centroid` belongs on a declaration: `dcl_centroid t0`".to_owned(),
            "bias" | "bx2" | "dz" | "dw" | "db" | "da" => {
                format!("`_{lower}` belongs on a source operand: `r0_{lower}`")
            }
            _ => format!(
                "write `{base}` without modifiers, or with some of these modifiers in any order: `{base}_x2_sat`"
            ),
        };
        return Err(SyntaxError::new(
            ErrorKind::UnknownInstructionModifier,
            span,
            "one of _x2 _x4 _x8 _d2 _d4 _d8 _sat _pp",
            quote(&format!("_{part}")),
            help,
        ));
    }
    Ok(())
}

fn unknown_opcode(token: &Token<'_>, base: &str) -> SyntaxError {
    let help = match nearest(base) {
        Some(near) => format!("did you mean `{near}`?"),
        None if base.eq_ignore_ascii_case("dp2") => "write `dp2add` with an addend of zero".to_owned(),
        None => "no version from ps_1_1 to ps_2_b, vs_1_1 or vs_2_0 has such an instruction".to_owned(),
    };
    SyntaxError::new(
        ErrorKind::UnknownOpcode,
        Span::new(token.span.start, token.span.start + base.len() as u32),
        "an instruction",
        quote(base),
        help,
    )
}

/// The mnemonic within edit distance 1 (2 for long words) of `word`, if any.
fn nearest(word: &str) -> Option<&'static str> {
    if word.len() > 16 {
        return None;
    }
    let lower = word.to_ascii_lowercase();
    let allowed = if lower.len() > 4 { 2 } else { 1 };
    Opcode::ALL
        .iter()
        .map(|opcode| opcode.info().mnemonic)
        .chain(["def", "defi", "defb", "dcl"])
        .map(|name| (distance(&lower, name), name))
        .filter(|&(d, _)| d <= allowed)
        .min_by_key(|&(d, _)| d)
        .map(|(_, name)| name)
}

/// Edit distance (Levenshtein) of two words, in bytes.
fn distance(a: &str, b: &str) -> usize {
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.bytes().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, y) in b.bytes().enumerate() {
            let replaced = diagonal + usize::from(x != y);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}
