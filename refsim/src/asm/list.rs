//! Lists of operands and values: commas, ends, and error recovery.

use super::error::{ErrorKind, Parsed, SyntaxError, quote};
use super::lexer::TokenKind;
use super::parser::Parser;
use super::word;
use crate::isa::{Destination, Source};

impl Parser<'_> {
    /// Returns `true` if the current token ends an operand list (without a comma before it).
    pub(super) fn at_list_end(&self) -> bool {
        let token = self.peek();
        match token.kind {
            TokenKind::Newline | TokenKind::End | TokenKind::Plus | TokenKind::OpenParen => true,
            TokenKind::Word => word::starts_statement(token.text) || word::is_version(token.text),
            _ => false,
        }
    }

    /// Consumes an optional comma between two items, and following line ends if the list continues on the next line.
    pub(super) fn comma(&mut self, first: bool) -> Parsed<()> {
        let Some(comma) = self.accept(TokenKind::Comma) else {
            return Ok(());
        };
        let mut ahead = 0;
        while self.peek_at(ahead).kind == TokenKind::Newline {
            ahead += 1;
        }
        let token = self.peek_at(ahead);
        let ends = match token.kind {
            TokenKind::Word => word::starts_statement(token.text) || word::is_version(token.text),
            // Only a number can follow: `def c0, +1`.
            TokenKind::Plus => self.peek_at(ahead + 1).kind != TokenKind::Number,
            TokenKind::Number | TokenKind::Minus | TokenKind::Bang => false,
            TokenKind::Comma | TokenKind::OpenParen | TokenKind::Newline | TokenKind::End => true,
            // If the operand is in this line, its own error is more specific.
            _ => ahead > 0,
        };
        if !ends && !first {
            self.at += ahead;
            return Ok(());
        }
        Err(SyntaxError::new(
            ErrorKind::MalformedOperand,
            comma.span,
            if first { "the first operand" } else { "an operand after the comma" },
            if first { quote(",") } else { self.peek().found() },
            "a comma can only be between two operands",
        ))
    }

    /// Parses a destination, if `has_destination`, and sources to the end of the list. Returns `None` after recording
    /// an error.
    pub(super) fn operands(&mut self, has_destination: bool) -> Option<(Option<Destination>, Vec<Source>)> {
        let mut destination = None;
        let mut sources = Vec::new();
        let mut good = true;
        let mut first = true;
        while first || !self.at_list_end() {
            if let Err(error) = self.comma(first) {
                self.record(error);
                good = false;
            }
            if self.peek().kind == TokenKind::Comma {
                continue;
            }
            if self.at_list_end() {
                break;
            }
            let read = if first && has_destination {
                self.destination().map(|d| destination = Some(d))
            } else {
                self.source().map(|s| sources.push(s))
            };
            if let Err(error) = read {
                self.record(error);
                self.skip_operand();
                good = false;
            }
            first = false;
        }
        good.then_some((destination, sources))
    }
}
