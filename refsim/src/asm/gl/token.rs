//! OpenGL program text in pieces, and a place in it.

use super::super::error::{AssembleErrors, ErrorKind, SyntaxError, quote};
use super::super::parser::Parsed;
use super::super::{MAX_ERRORS, MAX_STATEMENTS};
use crate::isa::Span;

/// The kinds of token.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Letters, digits, `_` and `$`, not starting with a digit.
    Word,
    /// Starts with a digit, or with a point and a digit.
    Number,
    /// One character of punctuation, or `..`.
    Mark,
    /// What no program contains.
    Unknown,
    End,
}

/// A token and its place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Token<'a> {
    pub(super) kind: Kind,
    pub(super) text: &'a str,
    pub(super) span: Span,
}

impl Token<'_> {
    /// The token as error messages name it.
    pub(super) fn found(&self) -> String {
        if self.kind == Kind::End { "the end of the program".to_owned() } else { quote(self.text) }
    }
}

const fn is_word(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_' || byte == b'$'
}

fn token_length(rest: &str) -> (Kind, usize) {
    let bytes = rest.as_bytes();
    let digit = |i: usize| bytes.get(i).is_some_and(u8::is_ascii_digit);
    match bytes[0] {
        b'.' if bytes.get(1) == Some(&b'.') => (Kind::Mark, 2),
        b if b.is_ascii_digit() || (b == b'.' && digit(1)) => (Kind::Number, number_length(bytes)),
        b if is_word(b) => (Kind::Word, bytes.iter().take_while(|&&b| is_word(b)).count()),
        b',' | b';' | b'.' | b'-' | b'+' | b'|' | b'(' | b')' | b'[' | b']' | b'{' | b'}' | b'=' => (Kind::Mark, 1),
        _ => (Kind::Unknown, rest.chars().next().map_or(1, char::len_utf8)),
    }
}

/// Everything that could belong to a number, so that `1.5x` is one malformed number; `0..3` is three tokens.
fn number_length(bytes: &[u8]) -> usize {
    let mut len = 1;
    while let Some(&byte) = bytes.get(len) {
        let sign = matches!(byte, b'+' | b'-') && bytes[len - 1].eq_ignore_ascii_case(&b'e');
        let sign = sign && bytes.get(len + 1).is_some_and(u8::is_ascii_digit);
        let range = byte == b'.' && bytes.get(len + 1) == Some(&b'.');
        if range || !(is_word(byte) || byte == b'.' || sign) {
            break;
        }
        len += 1;
    }
    len
}

/// Splits the text from byte `from` on. The last token is [`Kind::End`].
fn split(text: &str, from: usize) -> Vec<Token<'_>> {
    let mut tokens = Vec::new();
    let mut at = from;
    while let Some(&byte) = text.as_bytes().get(at) {
        if byte.is_ascii_whitespace() {
            at += 1;
        } else if byte == b'#' {
            at += text[at..].find(['\n', '\r']).unwrap_or(text.len() - at);
        } else {
            let (kind, len) = token_length(&text[at..]);
            let span = Span::new(at as u32, (at + len) as u32);
            tokens.push(Token { kind, text: &text[at..at + len], span });
            at += len;
        }
    }
    let end = text.len() as u32;
    tokens.push(Token { kind: Kind::End, text: "", span: Span::new(end, end) });
    tokens
}

/// A place in the text, and what was found wrong up to it.
pub(super) struct Cursor<'a> {
    tokens: Vec<Token<'a>>,
    at: usize,
    statements: usize,
    errors: Vec<SyntaxError>,
}

impl<'a> Cursor<'a> {
    pub(super) fn new(text: &'a str, from: u32) -> Self {
        Self { tokens: split(text, from as usize), at: 0, statements: 0, errors: Vec::new() }
    }

    pub(super) fn peek(&self) -> Token<'a> {
        self.tokens[self.at.min(self.tokens.len() - 1)]
    }

    pub(super) fn next(&mut self) -> Token<'a> {
        let token = self.peek();
        self.at = (self.at + 1).min(self.tokens.len() - 1);
        token
    }

    pub(super) fn accept(&mut self, mark: &str) -> bool {
        let found = self.peek().kind == Kind::Mark && self.peek().text == mark;
        if found {
            self.next();
        }
        found
    }

    pub(super) fn expect(&mut self, mark: &str, help: &str) -> Parsed<()> {
        if self.accept(mark) {
            return Ok(());
        }
        Err(self.unexpected(&format!("`{mark}`"), help))
    }

    /// The next token is not what has to stand there.
    pub(super) fn unexpected(&self, expected: &str, help: &str) -> SyntaxError {
        let token = self.peek();
        SyntaxError::new(ErrorKind::UnexpectedToken, token.span, expected, token.found(), help)
    }

    /// One of these words after a point, if it stands there.
    pub(super) fn after_point(&mut self, words: &[&'static str]) -> Option<&'static str> {
        let word = self.tokens.get(self.at + 1).filter(|_| self.peek().text == ".")?.text;
        let found = words.iter().copied().find(|w| *w == word)?;
        self.at += 2;
        Some(found)
    }

    /// The end of the token before.
    pub(super) fn last_end(&self) -> u32 {
        self.tokens[self.at.saturating_sub(1)].span.end
    }

    pub(super) fn record(&mut self, error: SyntaxError) {
        if self.errors.len() < MAX_ERRORS {
            self.errors.push(error);
        }
    }

    /// After a slip: to the statement after this one.
    pub(super) fn skip_statement(&mut self) {
        while self.peek().kind != Kind::End && !self.accept(";") {
            self.next();
        }
    }

    /// Whether another statement is read; if too much has been, that is recorded.
    pub(super) fn goes_on(&mut self) -> bool {
        let stop = |kind, limit: usize, what: &str, span| {
            let expected = format!("at most {limit} {what}");
            SyntaxError::new(kind, span, expected, "more of them", "the rest of the text was not read")
        };
        let span = self.peek().span;
        if self.errors.len() >= MAX_ERRORS {
            self.errors.push(stop(ErrorKind::TooManyErrors, MAX_ERRORS, "errors", span));
            return false;
        }
        if self.statements >= MAX_STATEMENTS {
            self.errors.push(stop(ErrorKind::TooManyStatements, MAX_STATEMENTS, "statements", span));
            return false;
        }
        self.statements += 1;
        true
    }

    /// After the last statement: `END`.
    pub(super) fn end(&mut self) {
        let token = self.next();
        if token.kind == Kind::End {
            self.record(SyntaxError::new(
                ErrorKind::MissingEnd,
                token.span,
                "`END`",
                token.found(),
                "close the program with `END`",
            ));
        }
    }

    /// The errors, in the order of the text; `None` if there are none.
    pub(super) fn finish(mut self) -> Option<AssembleErrors> {
        self.errors.sort_by_key(|error| error.span.start);
        (!self.errors.is_empty()).then_some(AssembleErrors { errors: self.errors })
    }
}
