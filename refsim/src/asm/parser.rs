//! Parser of Direct3D programs: statements and their prefixes.

use std::collections::BTreeMap;
use std::ops::{Deref, DerefMut};

use super::cursor::Cursor;
use super::error::{AssembleErrors, ErrorKind, Parsed, SyntaxError, quote};
use super::lexer::{Dialect, Token, TokenKind};
use super::limits::MAX_OPERANDS;
use super::word;
use crate::isa::{
    ConstantDef, Declaration, Destination, DestinationRule, Instruction, OpInfo, Predicate, Program, ProgramText,
    Source, Span, Version,
};

/// Parser of one text. A part that fails to parse returns its error; the statement records it, skips to a token where
/// the next part can start, and continues, so that no error hides another.
pub(super) struct Parser<'a> {
    cursor: Cursor<'a>,
    version: Option<(Version, Span)>,
    pub(super) constants: Vec<ConstantDef>,
    pub(super) declarations: Vec<Declaration>,
    pub(super) instructions: Vec<Instruction>,
}

impl<'a> Deref for Parser<'a> {
    type Target = Cursor<'a>;

    fn deref(&self) -> &Cursor<'a> {
        &self.cursor
    }
}

impl DerefMut for Parser<'_> {
    fn deref_mut(&mut self) -> &mut Self::Target {
        &mut self.cursor
    }
}

#[derive(Clone, Copy)]
struct StatementPrefix {
    coissue: bool,
    predicate: Option<Predicate>,
    span: Span,
}

impl<'a> Parser<'a> {
    /// Creates a parser.
    pub(super) fn new(text: &'a str) -> Self {
        let from = if text.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
        Self {
            cursor: Cursor::new(text, from, Dialect::Direct3d),
            version: None,
            constants: Vec::new(),
            declarations: Vec::new(),
            instructions: Vec::new(),
        }
    }

    /// Parses the whole program.
    pub(super) fn run(mut self) -> Result<Program, AssembleErrors> {
        self.skip_newlines();
        self.read_version();
        self.skip_newlines();
        while self.goes_on() && self.peek().kind != TokenKind::End {
            self.statement();
            self.skip_newlines();
        }
        let errors = self.finish().unwrap_or_else(|| AssembleErrors::new(Vec::new()));
        match self.version {
            Some((version, version_span)) if errors.errors.is_empty() => Ok(Program {
                version,
                version_span,
                constants: self.constants,
                declarations: self.declarations,
                instructions: self.instructions,
                resources: BTreeMap::new(),
                parameters: Vec::new(),
                fog: None,
                text: ProgramText::default(),
            }),
            _ => Err(errors),
        }
    }

    // ---- tokens ----

    /// Consumes and returns the current token, unless it ends the line.
    pub(super) fn next_in_line(&mut self) -> Token<'a> {
        let token = self.peek();
        if token.kind != TokenKind::Newline {
            self.next();
        }
        token
    }

    fn skip_newlines(&mut self) {
        while self.accept(TokenKind::Newline).is_some() {}
    }

    /// Skips to the next comma, the end of the line, or a co-issued instruction in the same line.
    pub(super) fn skip_operand(&mut self) {
        while !matches!(self.peek().kind, TokenKind::Comma | TokenKind::Newline | TokenKind::End) && !self.at_coissue()
        {
            self.next();
        }
    }

    fn skip_line(&mut self) {
        while !matches!(self.peek().kind, TokenKind::Newline | TokenKind::End) && !self.at_coissue() {
            self.next();
        }
    }

    fn at_coissue(&self) -> bool {
        let next = self.peek_at(1);
        self.peek().kind == TokenKind::Plus && next.kind == TokenKind::Word && word::starts_statement(next.text)
    }

    // ---- the version ----

    fn read_version(&mut self) {
        let token = self.peek();
        let all = Version::ALL.map(Version::token).join(" ");
        if token.kind != TokenKind::Word || !word::is_version(token.text) {
            self.record(token.error(
                ErrorKind::MissingVersion,
                "a shader version as the first word",
                format!("start the program with one of {all}"),
            ));
            return;
        }
        self.next();
        match token.text.parse() {
            Ok(version) => self.version = Some((version, token.span)),
            Err(_) => self.record(token.error(
                ErrorKind::UnknownVersion,
                format!("one of {all}"),
                match token.text.to_ascii_lowercase().as_str() {
                    "ps_2_x" => "write the variant: ps_2_a (NV3x) or ps_2_b (R4xx)",
                    "ps_1_0" | "ps.1.0" => "write ps_1_1: every ps_1_0 program is also a ps_1_1 program",
                    "vs_1_0" | "vs.1.0" => "write vs_1_1",
                    _ => "write the version that the program was written for, or the next lower version",
                },
            )),
        }
        let after = self.peek();
        if !matches!(after.kind, TokenKind::Newline | TokenKind::End | TokenKind::Word) {
            self.misplaced(after, "the end of the line");
            self.skip_line();
        }
    }

    // ---- statements ----

    fn misplaced(&mut self, token: Token<'a>, expected: &str) {
        let help = match token.text {
            "#" => "there is no preprocessor: write numbers and registers out",
            "{" | "}" => "blocks are delimited by words: if_gt ... else ... endif",
            "," => "a comma can only be between two operands",
            _ => "one instruction per line: mnemonic, destination, sources",
        };
        self.record(token.error(ErrorKind::UnexpectedToken, expected, help));
    }

    fn statement(&mut self) {
        let prefix = match self.prefix() {
            Ok(prefix) => prefix,
            Err(error) => {
                self.record(error);
                self.skip_line();
                return;
            }
        };
        let token = self.peek();
        if token.kind != TokenKind::Word {
            self.misplaced(token, "an instruction");
            self.next_in_line();
            self.skip_line();
            return;
        }
        self.next();
        let definition = word::is_definition(token.text);
        let declaration = word::base(token.text).eq_ignore_ascii_case("dcl");
        if (definition || declaration) && prefix.span.end > prefix.span.start {
            self.record(SyntaxError::new(
                ErrorKind::MisplacedPrefix,
                prefix.span,
                "an instruction after it",
                quote(token.text),
                "drop the prefix: definitions and declarations are not executed",
            ));
        }
        if definition {
            self.definition(token);
        } else if declaration {
            self.declaration(token);
        } else if word::is_version(token.text) {
            self.record(token.error(
                ErrorKind::RepeatedVersion,
                "one version, at the start",
                "put each program into a text of its own",
            ));
            self.skip_line();
        } else {
            self.instruction(token, prefix);
        }
    }

    fn prefix(&mut self) -> Parsed<StatementPrefix> {
        let start = self.peek().span.start;
        let coissue = self.accept(TokenKind::Plus).is_some();
        let predicate = if self.peek().kind == TokenKind::OpenParen { Some(self.predicate()?) } else { None };
        let end = if coissue || predicate.is_some() { self.last_end() } else { start };
        Ok(StatementPrefix { coissue, predicate, span: Span::new(start, end) })
    }

    fn instruction(&mut self, token: Token<'a>, prefix: StatementPrefix) {
        let mnemonic = match word::mnemonic(&token) {
            Ok(mnemonic) => mnemonic,
            Err(error) => {
                // The operands of a known instruction are parsed anyway, to report their errors too.
                let known = error.kind != ErrorKind::UnknownOpcode;
                self.record(error);
                if known && let Some(row) = word::row(token.text) {
                    self.operands(row.destination != DestinationRule::None);
                } else {
                    self.skip_line();
                }
                return;
            }
        };
        let info = mnemonic.opcode.info();
        let has_destination = info.destination != DestinationRule::None;
        let Some((mut destination, sources)) = self.operands(has_destination) else {
            return;
        };
        let start = if prefix.span.end > prefix.span.start { prefix.span.start } else { token.span.start };
        let span = Span::new(start, self.statement_end(token, destination, &sources));
        if let Some(error) = self.wrong_count(info, destination.is_some(), sources.len(), span) {
            self.record(error);
            return;
        }
        if let Some(destination) = &mut destination {
            destination.shift = mnemonic.shift;
            destination.saturate = mnemonic.saturate;
            destination.partial_precision = mnemonic.partial_precision;
        }
        self.instructions.push(Instruction {
            comparison: mnemonic.comparison,
            coissue: prefix.coissue,
            predicate: prefix.predicate,
            ..Instruction::new(mnemonic.opcode, destination, sources, span)
        });
    }

    fn statement_end(&self, token: Token<'_>, destination: Option<Destination>, sources: &[Source]) -> u32 {
        let operands = destination.map_or(token.span.end, |d| d.span.end);
        sources.last().map_or(operands, |s| s.span.end)
    }

    fn wrong_count(&self, info: &OpInfo, has_destination: bool, sources: usize, span: Span) -> Option<SyntaxError> {
        let destination = usize::from(info.destination != DestinationRule::None);
        let found = usize::from(has_destination) + sources;
        let wanted =
            self.version.and_then(|(version, _)| info.source_count(version)).map(|n| destination + usize::from(n));
        let right = match wanted {
            Some(wanted) => found == wanted,
            None => found >= destination && found <= MAX_OPERANDS,
        };
        if right {
            return None;
        }
        let name = info.mnemonic;
        let expected = match (wanted, self.version) {
            (Some(1), Some((version, _))) => format!("1 operand of `{name}` in {version}"),
            (Some(n), Some((version, _))) => format!("{n} operands of `{name}` in {version}"),
            _ => format!("{destination} to {MAX_OPERANDS} operands of `{name}`"),
        };
        let help = match (destination, wanted) {
            (0, Some(0)) => format!("`{name}` has no operands"),
            (0, _) => format!("`{name}` has no destination: it reads all its operands"),
            (_, Some(1)) => format!("`{name}` has no operand but its destination"),
            (_, Some(n)) => format!("operands of `{name}`: a destination and {} more", n - 1),
            (_, None) => format!("the first operand of `{name}` is its destination"),
        };
        Some(SyntaxError::new(ErrorKind::OperandCount, span, expected, found.to_string(), help))
    }
}
