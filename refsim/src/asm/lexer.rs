//! Lexer of both languages. It never fails: invalid input becomes a token that the parser rejects.

use super::error::{ErrorKind, SyntaxError, quote};
use crate::isa::Span;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Dialect {
    /// One statement per line; comments start with `;` or `//`, or are enclosed in `/*` and `*/`.
    Direct3d,
    /// Statements end with `;`; comments start with `#`.
    OpenGl,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TokenKind {
    /// Letters, digits and underscores (in OpenGL also `$`), not starting with a digit; a version token with its dots.
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
    /// Punctuation of OpenGL only: one of `;|{}=`, or `..`.
    OpenGlMark,
    Newline,
    /// A character that no program contains.
    Unknown,
    /// The end of the text; always the last token.
    End,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Token<'a> {
    pub(super) kind: TokenKind,
    pub(super) text: &'a str,
    pub(super) span: Span,
}

impl Token<'_> {
    /// The token as quoted in error messages.
    pub(super) fn found(&self) -> String {
        match self.kind {
            TokenKind::Newline => "the end of the line".to_owned(),
            TokenKind::End => "the end of the program".to_owned(),
            _ => quote(self.text),
        }
    }

    pub(super) fn error(&self, kind: ErrorKind, expected: impl Into<String>, help: impl Into<String>) -> SyntaxError {
        SyntaxError::new(kind, self.span, expected, self.found(), help)
    }
}

/// Tokenizes `text` from byte `from` on; its length must not exceed [`super::MAX_TEXT`].
pub(super) fn lex(text: &str, from: usize, dialect: Dialect) -> (Vec<Token<'_>>, Vec<SyntaxError>) {
    let mut lexer = Lexer { text, at: from, dialect, tokens: Vec::new(), errors: Vec::new() };
    while lexer.at < text.len() {
        lexer.step();
    }
    lexer.push(TokenKind::End, 0);
    (lexer.tokens, lexer.errors)
}

struct Lexer<'a> {
    text: &'a str,
    at: usize,
    dialect: Dialect,
    tokens: Vec<Token<'a>>,
    errors: Vec<SyntaxError>,
}

impl Lexer<'_> {
    fn rest(&self) -> &[u8] {
        &self.text.as_bytes()[self.at..]
    }

    fn is_word(&self, byte: u8) -> bool {
        byte.is_ascii_alphanumeric() || byte == b'_' || (byte == b'$' && self.dialect == Dialect::OpenGl)
    }

    fn span(&self, len: usize) -> Span {
        // The text's length is bounded by MAX_TEXT, so the casts lose nothing.
        Span::new(self.at as u32, (self.at + len) as u32)
    }

    fn push(&mut self, kind: TokenKind, len: usize) {
        let span = self.span(len);
        let text = &self.text[self.at..self.at + len];
        self.tokens.push(Token { kind, text, span });
        self.at += len;
    }

    fn step(&mut self) {
        let (byte, next) = (self.rest()[0], self.rest().get(1).copied());
        let opengl = self.dialect == Dialect::OpenGl;
        match byte {
            b' ' | b'\t' | b'\x0c' => self.at += 1,
            b'\n' | b'\r' if opengl => self.at += 1,
            b'\x0b' if !opengl => self.at += 1,
            b'\r' if next == Some(b'\n') => self.push(TokenKind::Newline, 2),
            b'\n' | b'\r' => self.push(TokenKind::Newline, 1),
            b'#' if opengl => self.line_comment(),
            b';' if !opengl => self.line_comment(),
            b'/' if next == Some(b'/') && !opengl => self.line_comment(),
            b'/' if next == Some(b'*') && !opengl => self.block_comment(),
            b',' => self.push(TokenKind::Comma, 1),
            b'+' => self.push(TokenKind::Plus, 1),
            b'-' => self.push(TokenKind::Minus, 1),
            b'!' if !opengl => self.push(TokenKind::Bang, 1),
            b'(' => self.push(TokenKind::OpenParen, 1),
            b')' => self.push(TokenKind::CloseParen, 1),
            b'[' => self.push(TokenKind::OpenBracket, 1),
            b']' => self.push(TokenKind::CloseBracket, 1),
            b';' | b'|' | b'{' | b'}' | b'=' if opengl => self.push(TokenKind::OpenGlMark, 1),
            b'.' if next == Some(b'.') && opengl => self.push(TokenKind::OpenGlMark, 2),
            b'.' if !next.is_some_and(|b| b.is_ascii_digit()) => self.push(TokenKind::Dot, 1),
            b'.' | b'0'..=b'9' => self.number(),
            b if self.is_word(b) => self.word(),
            _ => {
                let len = self.text[self.at..].chars().next().map_or(1, char::len_utf8);
                self.push(TokenKind::Unknown, len);
            }
        }
    }

    fn line_comment(&mut self) {
        let rest = self.rest();
        let len = rest.iter().position(|b| matches!(b, b'\n' | b'\r')).unwrap_or(rest.len());
        self.at += len;
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
        let rest = self.rest();
        let mut len = rest.iter().take_while(|&&b| self.is_word(b)).count();
        // DirectX 8 wrote versions with points.
        let stage = &rest[..len];
        let version = stage.eq_ignore_ascii_case(b"ps") || stage.eq_ignore_ascii_case(b"vs");
        if version && self.dialect == Dialect::Direct3d {
            len = rest.iter().take_while(|&&b| self.is_word(b) || b == b'.').count();
        }
        self.push(TokenKind::Word, len);
    }

    /// Consumes everything that could belong to a number, so that `1.5x` is one malformed number and not two tokens.
    fn number(&mut self) {
        if self.dialect == Dialect::OpenGl {
            return self.opengl_number();
        }
        let rest = self.rest();
        let hexadecimal = rest[0] == b'0' && rest.get(1).is_some_and(|b| b.eq_ignore_ascii_case(&b'x'));
        let mut len = 1;
        while let Some(&byte) = rest.get(len) {
            let exponent_sign = matches!(byte, b'+' | b'-')
                && !hexadecimal
                && rest[len - 1].eq_ignore_ascii_case(&b'e')
                && rest.get(len + 1).is_some_and(u8::is_ascii_digit);
            if !(self.is_word(byte) || byte == b'.' || exponent_sign) {
                break;
            }
            len += 1;
        }
        self.push(TokenKind::Number, len);
    }

    /// Consumes the longest number of OpenGL's grammar: digits, a point, digits, an exponent. `0..3` is three tokens,
    /// `3.14.x` is a number and its component; `1.x` is malformed, like `1.5x` and `1.5.5`.
    fn opengl_number(&mut self) {
        let rest = self.rest();
        let at = |i: usize| rest.get(i).copied().unwrap_or(0);
        let digits = |from: usize| rest[from.min(rest.len())..].iter().take_while(|b| b.is_ascii_digit()).count();
        let mut len = digits(0);
        if at(len) == b'.' && at(len + 1) != b'.' {
            len += 1 + digits(len + 1);
        }
        let signed = usize::from(matches!(at(len + 1), b'+' | b'-'));
        if matches!(at(len), b'e' | b'E') && at(len + 1 + signed).is_ascii_digit() {
            len += 1 + signed + digits(len + 1 + signed);
        }
        while self.is_word(at(len)) || (at(len) == b'.' && at(len + 1).is_ascii_digit()) {
            len += 1;
        }
        self.push(TokenKind::Number, len);
    }
}
