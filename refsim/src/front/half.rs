//! Rewrites operations of a WGSL text from f32 to f16.

use std::cmp::Reverse;

use crate::isa::Span;

/// An operation on f32 that can be rewritten in f16: its operands are converted to f16, and its result back to f32.
#[derive(Clone, Debug)]
pub struct WgslOperation {
    /// Span of the operation in the text.
    pub span: Span,
    casts: Vec<Cast>,
    /// Byte offset of the operator of a compound assignment, which the rewriting removes.
    removed: Option<usize>,
}

/// A conversion such as `vec3h(`, to be inserted before a part of the text, with a closing bracket after the part.
#[derive(Clone, Debug)]
struct Cast {
    start: usize,
    end: usize,
    open: String,
}

/// Syntax of an operation in the text.
#[derive(Clone, Copy)]
pub(super) enum OperationForm {
    /// A function call; every operand is an argument.
    Call,
    /// A function that exists only for f32: its operands and its result are rounded to f16.
    CallOfF32,
    /// An operator between two operands, or the operator of a compound assignment.
    Operator(&'static str),
}

/// A word or punctuation mark of a text.
#[derive(Clone, Copy)]
struct Token {
    start: usize,
    end: usize,
    /// Nesting depth in brackets.
    depth: usize,
    /// `true` if an operand ends just before the token.
    follows: bool,
}

/// The f16 type for the name of an f32 type.
fn half(name: &str) -> String {
    let columns = name.strip_suffix('f').filter(|_| name != "f32");
    columns.map_or_else(|| "f16".to_owned(), |columns| format!("{columns}h"))
}

/// Length of the word at the start of a text, including type arguments in `<>` that follow it.
fn word(text: &str) -> usize {
    let is_number = !text.starts_with(|c: char| c.is_alphabetic() || c == '_');
    let is_hexadecimal = text.starts_with("0x") || text.starts_with("0X");
    let (mut before, signed) = (' ', if is_hexadecimal { ['p', 'P'] } else { ['e', 'E'] });
    let end = text.find(|c: char| {
        let sign = is_number && (c == '+' || c == '-') && signed.contains(&before);
        before = c;
        !(c.is_alphanumeric() || c == '_' || c == '.' || sign)
    });
    let end = end.unwrap_or(text.len());
    let takes_types = matches!(&text[..end], "vec2" | "vec3" | "vec4" | "array" | "bitcast" | "ptr")
        || (end == 6 && text.starts_with("mat"));
    if !takes_types || !text[end..].starts_with('<') {
        return end;
    }
    let mut open = 0;
    let closes = text[end..].find(|c: char| {
        open += i32::from(c == '<') - i32::from(c == '>');
        open == 0
    });
    closes.map_or(end, |at| end + at + 1)
}

/// Length of the comment at the start of a text, 0 if there is none. Comments between `/*` and `*/` nest.
pub(super) fn comment(text: &str) -> usize {
    if text.starts_with("//") {
        const LINE_ENDS: [char; 7] = ['\n', '\u{b}', '\u{c}', '\r', '\u{85}', '\u{2028}', '\u{2029}'];
        return text.find(LINE_ENDS).unwrap_or(text.len());
    }
    if !text.starts_with("/*") {
        return 0;
    }
    let (mut at, mut open) = (2, 1);
    while open > 0 {
        match text.as_bytes().get(at..at + 2) {
            Some(b"/*") => (at, open) = (at + 2, open + 1),
            Some(b"*/") => (at, open) = (at + 2, open - 1),
            Some(_) => at += 1,
            None => return text.len(),
        }
    }
    at
}

/// Words and marks of a text without its comments.
fn tokens(text: &str) -> Vec<Token> {
    const PAIRS: [&str; 15] =
        ["<<", "<=", ">>", ">=", "==", "!=", "&&", "||", "+=", "-=", "*=", "/=", "%=", "->", "::"];
    let mut found = Vec::new();
    let (mut start, mut depth, mut follows) = (0, 0_usize, false);
    while let Some(first) = text[start..].chars().next() {
        let rest = &text[start..];
        let is_word = first.is_alphanumeric() || first == '_' || first == '.';
        let skipped = if first.is_whitespace() { first.len_utf8() } else { comment(rest) };
        let length = match skipped {
            1.. => skipped,
            _ if is_word => word(rest),
            _ => PAIRS.iter().find(|pair| rest.starts_with(**pair)).map_or(first.len_utf8(), |pair| pair.len()),
        };
        let end = start + length;
        if skipped == 0 {
            let closes = first == ')' || first == ']';
            depth -= usize::from(closes && depth > 0);
            found.push(Token { start, end, depth, follows });
            depth += usize::from(first == '(' || first == '[');
            follows = is_word || closes;
        }
        start = end;
    }
    found
}

/// Returns `true` if a text declares a name of f16 or of a type of f16 as its own.
pub(super) fn redefines_half(text: &str) -> bool {
    const DECLARES: [&str; 8] = ["let", "const", "var", "override", "alias", "fn", "struct", ">"];
    let words: Vec<&str> = tokens(text).iter().map(|token| &text[token.start..token.end]).collect();
    words.windows(3).any(|three| {
        let [before, name, behind] = three else { return false };
        let is_half = *name == "f16" || ((name.starts_with("vec") || name.starts_with("mat")) && name.ends_with('h'));
        is_half && (DECLARES.contains(before) || *behind == ":")
    })
}

impl WgslOperation {
    /// The operation at a span of the text. `operands` are the names of the operands' types in the order of the text,
    /// and `result` is the name of the result's type; a name is `None` if the type does not consist of f32. Returns
    /// `None` if the text has another form.
    pub(super) fn new(
        text: &str,
        span: Span,
        form: OperationForm,
        operands: &[Option<String>],
        result: Option<&str>,
    ) -> Option<Self> {
        let first = span.start as usize;
        let own = text.get(first..span.end as usize)?;
        let tokens = tokens(own);
        let is = |token: &Token, mark: &str| &own[token.start..token.end] == mark;
        let mut casts = Vec::new();
        let mut cast = |range: &[Token], open: String| {
            let (start, end) = (range.first()?.start + first, range.last()?.end + first);
            casts.push(Cast { start, end, open });
            Some(())
        };
        let (mut removed, mut parts) = (None, Vec::new());
        let back = result.map(|name| format!("{name}("));
        if let OperationForm::Operator(mark) = form {
            let at = tokens.iter().rposition(|token| token.depth == 0 && token.follows && is(token, mark));
            let assigns = format!("{mark}=");
            match tokens.iter().position(|token| token.depth == 0 && is(token, &assigns)) {
                // A call in the target would be made twice.
                Some(at) if tokens[..at].iter().any(|token| is(token, "(")) => return None,
                Some(at) => {
                    let target = &own[tokens.first()?.start..tokens.get(at.checked_sub(1)?)?.end];
                    let target = match operands.first()? {
                        Some(name) => format!("{}({target})", half(name)),
                        None => target.to_owned(),
                    };
                    cast(&tokens[at + 1..], format!("{}{target} {mark} ", back?))?;
                    removed = Some(first + tokens[at].start);
                    parts.push((&tokens[at + 1..], operands.get(1)?));
                }
                None => {
                    back.into_iter().try_for_each(|open| cast(&tokens, open))?;
                    parts.extend([&tokens[..at?], &tokens[at? + 1..]].into_iter().zip(operands));
                }
            }
        } else {
            back.into_iter().try_for_each(|open| cast(&tokens, open))?;
            if let (OperationForm::CallOfF32, Some(name)) = (form, result) {
                cast(&tokens, format!("{}(", half(name)))?;
            }
            let inside = &tokens[tokens.iter().position(|token| is(token, "("))? + 1..tokens.len().checked_sub(1)?];
            let arguments = inside.split(|token| token.depth == 1 && is(token, ","));
            parts.extend(arguments.filter(|part| !part.is_empty()).zip(operands));
        }
        for (part, name) in &parts {
            let Some(name) = name else { continue };
            let mut part = *part;
            while let [open, inside @ .., _] = part
                && is(open, "(")
                && inside.iter().all(|token| token.depth > open.depth)
            {
                part = inside;
            }
            // A literal next to a vector is a single component.
            let is_number =
                part.len() == 1 && own[part[0].start..].starts_with(|c: char| c.is_ascii_digit() || c == '.');
            let name = if is_number { "f32" } else { name };
            if let OperationForm::CallOfF32 = form {
                cast(part, format!("{name}("))?;
            }
            cast(part, format!("{}(", half(name)))?;
        }
        let complete = matches!(form, OperationForm::Operator(_)) || parts.len() == operands.len();
        complete.then_some(Self { span, casts, removed })
    }

    /// The text with these operations rewritten in f16.
    pub fn in_half<'o>(text: &str, operations: impl IntoIterator<Item = &'o Self>) -> String {
        let mut operations: Vec<&Self> = operations.into_iter().collect();
        // Enclosing operations come first, so that casts of the same part are in order.
        operations.sort_by_key(|operation| Reverse(operation.span.end - operation.span.start));
        let mut casts: Vec<&Cast> = operations.iter().flat_map(|operation| &operation.casts).collect();
        casts.sort_by_key(|cast| (cast.start, Reverse(cast.end)));
        let mut kept: Vec<&Cast> = Vec::new();
        for cast in casts {
            // Omits a conversion to f32 that is directly converted back: an f16 result can be an f16 operand.
            let is_back = |last: &&&Cast| {
                let name = cast.open.strip_suffix('(').filter(|name| !name.contains('('));
                (last.start, last.end) == (cast.start, cast.end)
                    && name.is_some_and(|name| last.open == half(name) + "(")
            };
            match kept.last().filter(is_back) {
                Some(_) => drop(kept.pop()),
                None => kept.push(cast),
            }
        }
        let removed = |at: usize| operations.iter().any(|operation| operation.removed == Some(at));
        let is_enabled = text.lines().any(|line| line.trim_start().starts_with("enable f16"));
        let mut made = if is_enabled { String::new() } else { "enable f16;\n".to_owned() };
        let (mut kept, mut ends) = (kept.into_iter().peekable(), Vec::new());
        for (at, c) in text.char_indices() {
            while ends.last() == Some(&at) {
                ends.pop();
                made.push(')');
            }
            while let Some(cast) = kept.next_if(|cast| cast.start == at) {
                made.push_str(&cast.open);
                ends.push(cast.end);
            }
            made.extend(Some(c).filter(|_| !removed(at)));
        }
        ends.iter().for_each(|_| made.push(')'));
        made
    }
}
