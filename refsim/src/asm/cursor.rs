//! Cursor over the tokens of a text, with the errors found so far.

use super::error::{AssembleErrors, ErrorKind, Parsed, SyntaxError};
use super::lexer::{Dialect, Token, TokenKind, lex};
use super::limits::{MAX_ERRORS, MAX_STATEMENTS};

/// The tokens of a text, the position of the next one, and the errors found so far.
pub(super) struct Cursor<'a> {
    tokens: Vec<Token<'a>>,
    pub(super) at: usize,
    statements: usize,
    errors: Vec<SyntaxError>,
}

impl<'a> Cursor<'a> {
    /// Creates a cursor at byte `from` of `text`.
    pub(super) fn new(text: &'a str, from: usize, dialect: Dialect) -> Self {
        let (tokens, errors) = lex(text, from, dialect);
        Self { tokens, at: 0, statements: 0, errors }
    }

    pub(super) fn peek(&self) -> Token<'a> {
        self.peek_at(0)
    }

    /// The token `ahead` positions after the next; past the end, the end token.
    pub(super) fn peek_at(&self, ahead: usize) -> Token<'a> {
        self.tokens[(self.at + ahead).min(self.tokens.len() - 1)]
    }

    pub(super) fn next(&mut self) -> Token<'a> {
        let token = self.peek();
        self.at = (self.at + 1).min(self.tokens.len() - 1);
        token
    }

    pub(super) fn accept(&mut self, kind: TokenKind) -> Option<Token<'a>> {
        (self.peek().kind == kind).then(|| self.next())
    }

    /// Consumes the next token if it is this mark.
    pub(super) fn accept_mark(&mut self, mark: &str) -> bool {
        let found = self.peek().text == mark;
        if found {
            self.next();
        }
        found
    }

    /// Consumes the next token, which must be `mark`; anything else is an error.
    pub(super) fn expect(&mut self, mark: &str, help: &str) -> Parsed<()> {
        if self.accept_mark(mark) {
            return Ok(());
        }
        Err(self.unexpected(&format!("`{mark}`"), help))
    }

    /// Creates the error for a next token that is not the expected one.
    pub(super) fn unexpected(&self, expected: &str, help: &str) -> SyntaxError {
        let token = self.peek();
        token.error(ErrorKind::UnexpectedToken, expected, help)
    }

    /// Consumes a point and one of these words, if they come next.
    pub(super) fn after_point(&mut self, words: &[&'static str]) -> Option<&'static str> {
        let word = self.tokens.get(self.at + 1).filter(|_| self.peek().text == ".")?.text;
        let found = words.iter().copied().find(|w| *w == word)?;
        self.at += 2;
        Some(found)
    }

    pub(super) fn last_end(&self) -> u32 {
        self.tokens[self.at.saturating_sub(1)].span.end
    }

    /// Adds an error, up to [`MAX_ERRORS`].
    pub(super) fn record(&mut self, error: SyntaxError) {
        if self.errors.len() < MAX_ERRORS {
            self.errors.push(error);
        }
    }

    /// Skips to the next statement, to recover from an error in an OpenGL program.
    pub(super) fn skip_statement(&mut self) {
        while self.peek().kind != TokenKind::End && !self.accept_mark(";") {
            self.next();
        }
    }

    /// Returns `true` if another statement can be parsed; records an error at the limit of errors or statements.
    pub(super) fn goes_on(&mut self) -> bool {
        let token = self.peek();
        let (kind, limit, what) = if self.errors.len() >= MAX_ERRORS {
            (ErrorKind::TooManyErrors, MAX_ERRORS, "errors")
        } else if self.statements >= MAX_STATEMENTS && token.kind != TokenKind::End {
            (ErrorKind::TooManyStatements, MAX_STATEMENTS, "statements")
        } else {
            self.statements += 1;
            return true;
        };
        let (expected, help) = (format!("at most {limit} {what}"), "the rest of the text was not read");
        self.errors.push(SyntaxError::new(kind, token.span, expected, "more of them", help));
        false
    }

    /// The errors, in the order of the text; `None` if there are none.
    pub(super) fn finish(&mut self) -> Option<AssembleErrors> {
        let mut errors = std::mem::take(&mut self.errors);
        errors.sort_by_key(|error| error.span.start);
        (!errors.is_empty()).then(|| AssembleErrors::new(errors))
    }
}
