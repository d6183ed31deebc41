//! Text to tokens. Never fails: what fits nowhere becomes a token that the parser will refuse in its place.

use super::error::{ErrorKind, SyntaxError, quote};
use crate::isa::Span;

/// The kinds of token.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Letters, digits and underscores, not starting with a digit; a version token with its dots.
    Word,
    /// Starts with a digit, or with a point and a digit. Not necessarily well formed.
    Number,
    Comma,
    Dot,
    Plus,
    Minus,
    Bang,
    OpenParen,
    CloseParen,
    OpenBracket,
    CloseBracket,
    Newline,
    /// A character that no program contains.
    Unknown,
    /// The end of the text; always the last token.
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
        match self.kind {
            Kind::Newline => "the end of the line".to_owned(),
            Kind::End => "the end of the program".to_owned(),
            _ => quote(self.text),
        }
    }
}

/// Splits `text`, which must not be longer than [`super::MAX_TEXT`].
pub(super) fn lex(text: &str) -> (Vec<Token<'_>>, Vec<SyntaxError>) {
    let mut lexer = Lexer { text, at: 0, tokens: Vec::new(), errors: Vec::new() };
    if text.starts_with('\u{feff}') {
        lexer.at = '\u{feff}'.len_utf8();
    }
    while lexer.at < text.len() {
        lexer.step();
    }
    lexer.push(Kind::End, 0);
    (lexer.tokens, lexer.errors)
}

struct Lexer<'a> {
    text: &'a str,
    at: usize,
    tokens: Vec<Token<'a>>,
    errors: Vec<SyntaxError>,
}

const fn is_word(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_'
}

impl Lexer<'_> {
    fn byte(&self, ahead: usize) -> Option<u8> {
        self.text.as_bytes().get(self.at + ahead).copied()
    }

    fn span(&self, len: usize) -> Span {
        // The text's length is bounded by MAX_TEXT, so the casts lose nothing.
        Span::new(self.at as u32, (self.at + len) as u32)
    }

    fn push(&mut self, kind: Kind, len: usize) {
        let span = self.span(len);
        let text = &self.text[self.at..self.at + len];
        self.tokens.push(Token { kind, text, span });
        self.at += len;
    }

    fn step(&mut self) {
        let Some(byte) = self.byte(0) else { return };
        let next = self.byte(1);
        match byte {
            b' ' | b'\t' | b'\x0b' | b'\x0c' => self.at += 1,
            b'\r' if next == Some(b'\n') => self.push(Kind::Newline, 2),
            b'\n' | b'\r' => self.push(Kind::Newline, 1),
            b';' => self.line_comment(),
            b'/' if next == Some(b'/') => self.line_comment(),
            b'/' if next == Some(b'*') => self.block_comment(),
            b',' => self.push(Kind::Comma, 1),
            b'+' => self.push(Kind::Plus, 1),
            b'-' => self.push(Kind::Minus, 1),
            b'!' => self.push(Kind::Bang, 1),
            b'(' => self.push(Kind::OpenParen, 1),
            b')' => self.push(Kind::CloseParen, 1),
            b'[' => self.push(Kind::OpenBracket, 1),
            b']' => self.push(Kind::CloseBracket, 1),
            b'.' if !next.is_some_and(|b| b.is_ascii_digit()) => self.push(Kind::Dot, 1),
            b'.' | b'0'..=b'9' => self.number(),
            b if is_word(b) => self.word(),
            _ => {
                let len = self.text[self.at..].chars().next().map_or(1, char::len_utf8);
                self.push(Kind::Unknown, len);
            }
        }
    }

    fn line_comment(&mut self) {
        let rest = &self.text.as_bytes()[self.at..];
        let len = rest.iter().position(|b| matches!(b, b'\n' | b'\r'));
        self.at += len.unwrap_or(rest.len());
    }

    fn block_comment(&mut self) {
        match self.text[self.at + 2..].find("*/") {
            Some(len) => self.at += 2 + len + 2,
            None => {
                self.errors.push(SyntaxError::new(
                    ErrorKind::UnclosedComment,
                    self.span(2),
                    "`*/` after `/*`",
                    "the end of the program",
                    "close the comment, or start it with `//`",
                ));
                self.at = self.text.len();
            }
        }
    }

    fn word(&mut self) {
        let rest = &self.text.as_bytes()[self.at..];
        let mut len = rest.iter().take_while(|&&b| is_word(b)).count();
        // DirectX 8 wrote versions with points.
        let stage = &rest[..len];
        if stage.eq_ignore_ascii_case(b"ps") || stage.eq_ignore_ascii_case(b"vs") {
            len = rest.iter().take_while(|&&b| is_word(b) || b == b'.').count();
        }
        self.push(Kind::Word, len);
    }

    /// Takes everything that could belong to a number, so that `1.5x` is one malformed number and not two tokens.
    fn number(&mut self) {
        let rest = &self.text.as_bytes()[self.at..];
        let hexadecimal = rest.len() > 1 && rest[0] == b'0' && rest[1].eq_ignore_ascii_case(&b'x');
        let mut len = 1;
        while let Some(&byte) = rest.get(len) {
            let exponent_sign = matches!(byte, b'+' | b'-')
                && !hexadecimal
                && rest[len - 1].eq_ignore_ascii_case(&b'e')
                && rest.get(len + 1).is_some_and(u8::is_ascii_digit);
            if !(is_word(byte) || byte == b'.' || exponent_sign) {
                break;
            }
            len += 1;
        }
        self.push(Kind::Number, len);
    }
}
