//! Tokens to a program: statements, and what is in front of them.

use super::error::{AssembleErrors, ErrorKind, SyntaxError, quote};
use super::lexer::{Kind, Token};
use super::{MAX_ERRORS, MAX_OPERANDS, MAX_STATEMENTS, word};
use crate::isa::{
    ConstantDef, Declaration, Destination, DestinationRule, FragmentPart, Instruction, OpInfo, Predicate, Program,
    Source, Span, Swizzle, Version,
};

/// The result of reading one part of a statement.
pub(super) type Parsed<T> = Result<T, SyntaxError>;

/// The state of reading one text. A part that reads badly returns its error; the statement records it, skips
/// to where the next part can start, and goes on, so that one slip hides no other.
pub(super) struct Parser<'a> {
    tokens: Vec<Token<'a>>,
    pub(super) at: usize,
    errors: Vec<SyntaxError>,
    version: Option<(Version, Span)>,
    pub(super) constants: Vec<ConstantDef>,
    pub(super) declarations: Vec<Declaration>,
    pub(super) instructions: Vec<Instruction>,
}

/// What a statement may have in front.
#[derive(Clone, Copy)]
struct Prefix {
    coissue: bool,
    predicate: Option<Predicate>,
    span: Span,
}

impl<'a> Parser<'a> {
    /// A parser of `tokens`, which end with [`Kind::End`].
    pub(super) fn new(tokens: Vec<Token<'a>>, errors: Vec<SyntaxError>) -> Self {
        Self {
            tokens,
            at: 0,
            errors,
            version: None,
            constants: Vec::new(),
            declarations: Vec::new(),
            instructions: Vec::new(),
        }
    }

    /// Reads the whole program.
    pub(super) fn run(mut self) -> Result<Program, AssembleErrors> {
        self.skip_newlines();
        self.read_version();
        let mut statements = 0;
        loop {
            self.skip_newlines();
            let token = self.peek();
            if self.errors.len() >= MAX_ERRORS {
                self.stop(ErrorKind::TooManyErrors, MAX_ERRORS, "errors");
                break;
            }
            if token.kind == Kind::End {
                break;
            }
            if statements >= MAX_STATEMENTS {
                self.stop(ErrorKind::TooManyStatements, MAX_STATEMENTS, "statements");
                break;
            }
            statements += 1;
            self.statement();
        }
        self.finish()
    }

    /// Says that the rest of the text is not read.
    fn stop(&mut self, kind: ErrorKind, limit: usize, what: &str) {
        self.errors.push(SyntaxError::new(
            kind,
            self.peek().span,
            format!("at most {limit} {what}"),
            "more of them",
            "the rest of the text was not read",
        ));
    }

    fn finish(mut self) -> Result<Program, AssembleErrors> {
        match self.version {
            Some((version, version_span)) if self.errors.is_empty() => Ok(Program {
                version,
                version_span,
                constants: self.constants,
                declarations: self.declarations,
                instructions: self.instructions,
                parameters: Vec::new(),
            }),
            _ => {
                self.errors.sort_by_key(|error| error.span.start);
                Err(AssembleErrors { errors: self.errors })
            }
        }
    }

    // ---- tokens ----

    pub(super) fn peek(&self) -> Token<'a> {
        self.peek_at(0)
    }

    /// The token `ahead` places on; the end for ever after the last.
    pub(super) fn peek_at(&self, ahead: usize) -> Token<'a> {
        let last = self.tokens.len() - 1;
        self.tokens[(self.at + ahead).min(last)]
    }

    pub(super) fn next(&mut self) -> Token<'a> {
        let token = self.peek();
        self.at = (self.at + 1).min(self.tokens.len() - 1);
        token
    }

    pub(super) fn accept(&mut self, kind: Kind) -> Option<Token<'a>> {
        (self.peek().kind == kind).then(|| self.next())
    }

    /// The end of the token before the current one.
    pub(super) fn last_end(&self) -> u32 {
        self.tokens[self.at.saturating_sub(1)].span.end
    }

    /// Adds an error, up to [`MAX_ERRORS`].
    pub(super) fn record(&mut self, error: SyntaxError) {
        if self.errors.len() < MAX_ERRORS {
            self.errors.push(error);
        }
    }

    /// Takes the current token unless it ends the line, and returns it.
    pub(super) fn next_in_line(&mut self) -> Token<'a> {
        let token = self.peek();
        if token.kind != Kind::Newline {
            self.next();
        }
        token
    }

    fn skip_newlines(&mut self) {
        while self.accept(Kind::Newline).is_some() {}
    }

    /// Skips to the next comma, the end of the line, or a co-issued instruction in the same line.
    pub(super) fn skip_operand(&mut self) {
        while !matches!(self.peek().kind, Kind::Comma | Kind::Newline | Kind::End) && !self.at_coissue() {
            self.next();
        }
    }

    fn skip_line(&mut self) {
        while !matches!(self.peek().kind, Kind::Newline | Kind::End) && !self.at_coissue() {
            self.next();
        }
    }

    fn at_coissue(&self) -> bool {
        let next = self.peek_at(1);
        self.peek().kind == Kind::Plus && next.kind == Kind::Word && word::starts_statement(next.text)
    }

    // ---- the version ----

    fn read_version(&mut self) {
        let token = self.peek();
        let all = Version::ALL.map(Version::token).join(" ");
        if token.kind != Kind::Word || !word::is_version(token.text) {
            self.record(SyntaxError::new(
                ErrorKind::MissingVersion,
                token.span,
                "a shader version as the first word",
                token.found(),
                format!("start the program with one of {all}"),
            ));
            return;
        }
        self.next();
        match token.text.parse() {
            Ok(version) => self.version = Some((version, token.span)),
            Err(_) => self.record(SyntaxError::new(
                ErrorKind::UnknownVersion,
                token.span,
                format!("one of {all}"),
                token.found(),
                match token.text.to_ascii_lowercase().as_str() {
                    "ps_2_x" => "name the flavour: ps_2_a (NV3x) or ps_2_b (R4xx)",
                    "ps_1_0" | "ps.1.0" => "every ps_1_0 program is a ps_1_1 program",
                    "vs_1_0" | "vs.1.0" => "write vs_1_1",
                    _ => "write the version that the program was made for, or the next lower one",
                },
            )),
        }
        let after = self.peek();
        if !matches!(after.kind, Kind::Newline | Kind::End | Kind::Word) {
            self.unexpected(after, "the end of the line");
            self.skip_line();
        }
    }

    // ---- statements ----

    fn unexpected(&mut self, token: Token<'a>, expected: &str) {
        let help = match token.text {
            "#" => "there is no preprocessor: write numbers and registers out",
            "{" | "}" => "blocks are delimited by words: if_gt ... else ... endif",
            "," => "a comma stands between two operands only",
            _ => "one instruction a line: mnemonic, destination, sources",
        };
        self.record(SyntaxError::new(ErrorKind::UnexpectedToken, token.span, expected, token.found(), help));
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
        if token.kind != Kind::Word {
            self.unexpected(token, "an instruction");
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
            self.record(SyntaxError::new(
                ErrorKind::RepeatedVersion,
                token.span,
                "one version, in front",
                token.found(),
                "put each program into a text of its own",
            ));
            self.skip_line();
        } else {
            self.instruction(token, prefix);
        }
    }

    fn prefix(&mut self) -> Parsed<Prefix> {
        let start = self.peek().span.start;
        let coissue = self.accept(Kind::Plus).is_some();
        let predicate = if self.peek().kind == Kind::OpenParen { Some(self.predicate()?) } else { None };
        let end = if coissue || predicate.is_some() { self.last_end() } else { start };
        Ok(Prefix { coissue, predicate, span: Span::new(start, end) })
    }

    /// `(p0)`, `(!p0.x)`
    fn predicate(&mut self) -> Parsed<Predicate> {
        let open = self.next();
        let not = self.accept(Kind::Bang).is_some();
        let bad = |token: Token<'_>, expected: &str| {
            SyntaxError::new(
                ErrorKind::Predicate,
                token.span,
                expected,
                token.found(),
                "write `(p0)`, `(!p0)` or `(p0.x)` in front of the instruction",
            )
        };
        let name = self.next_in_line();
        if name.kind != Kind::Word || !name.text.eq_ignore_ascii_case("p0") {
            return Err(bad(name, "the predicate register `p0`"));
        }
        let swizzle = match self.accept(Kind::Dot) {
            Some(_) => {
                let letters = self.next_in_line();
                if letters.kind != Kind::Word {
                    return Err(bad(letters, "one to four of xyzw"));
                }
                super::operand::swizzle(letters.text, letters.span)?
            }
            None => Swizzle::IDENTITY,
        };
        let close = self.peek();
        if close.kind != Kind::CloseParen {
            return Err(bad(close, "`)`"));
        }
        self.next();
        Ok(Predicate { not, swizzle, span: open.span.join(close.span) })
    }

    fn instruction(&mut self, token: Token<'a>, prefix: Prefix) {
        let mnemonic = match word::mnemonic(&token) {
            Ok(mnemonic) => mnemonic,
            Err(error) => {
                // The operands of a known instruction are still worth reading, for their own errors.
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
            opcode: mnemonic.opcode,
            comparison: mnemonic.comparison,
            destination,
            sources,
            coissue: prefix.coissue,
            predicate: prefix.predicate,
            fragment: FragmentPart::default(),
            span,
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
            (0, Some(0)) => format!("`{name}` stands alone"),
            (0, _) => format!("`{name}` has no destination; its operands are all read"),
            (_, Some(1)) => format!("`{name}` takes its destination only"),
            (_, Some(n)) => format!("`{name}` takes a destination and {} more", n - 1),
            (_, None) => format!("`{name}` takes a destination first"),
        };
        Some(SyntaxError::new(ErrorKind::OperandCount, span, expected, found.to_string(), help))
    }
}
