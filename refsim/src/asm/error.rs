//! Syntax errors of program texts.

use crate::isa::{PlacedMessage, ProgramText, Span};
use miette::{Diagnostic, LabeledSpan};
use std::fmt;

/// Kind of a syntax error.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
pub enum ErrorKind {
    /// The text exceeds [`super::MAX_TEXT`].
    #[error("program text too long")]
    TextTooLong,
    /// The text has more statements than [`super::MAX_STATEMENTS`].
    #[error("too many statements")]
    TooManyStatements,
    /// The list of errors was truncated at [`super::MAX_ERRORS`].
    #[error("too many errors")]
    TooManyErrors,
    /// A `/*` without `*/`.
    #[error("unclosed comment")]
    UnclosedComment,
    /// The text doesn't start with a version token.
    #[error("missing shader version")]
    MissingVersion,
    /// The version token is unknown.
    #[error("unknown shader version")]
    UnknownVersion,
    /// A second version token.
    #[error("second shader version")]
    RepeatedVersion,
    /// A token that cannot start or continue a statement.
    #[error("misplaced text")]
    UnexpectedToken,
    /// An instruction that exists in no version.
    #[error("unknown instruction")]
    UnknownOpcode,
    /// A modifier or comparison that the instruction lacks.
    #[error("unknown instruction modifier")]
    UnknownInstructionModifier,
    /// A repeated modifier, or two modifiers of the same kind.
    #[error("repeated modifier")]
    RepeatedModifier,
    /// A result modifier (`_sat` etc.) on an instruction without destination.
    #[error("modifier without a destination")]
    ModifierWithoutDestination,
    /// `setp` without a comparison (`_gt` etc.).
    #[error("missing comparison")]
    MissingComparison,
    /// Too few or too many operands.
    #[error("wrong number of operands")]
    OperandCount,
    /// A token that is not an operand.
    #[error("malformed operand")]
    MalformedOperand,
    /// A register that exists in no version.
    #[error("unknown register")]
    UnknownRegister,
    /// A register without its number.
    #[error("missing register number")]
    MissingRegisterNumber,
    /// A register number or usage index out of range.
    #[error("register number out of range")]
    RegisterNumber,
    /// A swizzle that is not one to four letters of a single set (xyzw or rgba).
    #[error("malformed swizzle")]
    Swizzle,
    /// A mask with repeated, unordered or invalid letters.
    #[error("malformed write mask")]
    Mask,
    /// An unknown source modifier.
    #[error("unknown source modifier")]
    UnknownSourceModifier,
    /// Source modifiers that cannot be combined.
    #[error("source modifiers that do not combine")]
    SourceModifierClash,
    /// A source modifier on a destination.
    #[error("source modifier on a destination")]
    ModifierOnDestination,
    /// A malformed relative address in brackets.
    #[error("malformed relative address")]
    RelativeAddress,
    /// A malformed predicate before an instruction.
    #[error("malformed predicate")]
    Predicate,
    /// `+` or a predicate before a statement that allows neither.
    #[error("misplaced prefix")]
    MisplacedPrefix,
    /// A value that is not a number, integer or boolean.
    #[error("malformed value")]
    MalformedValue,
    /// A value out of range for the constant.
    #[error("value out of range")]
    ValueRange,
    /// Too few or too many values in a `def`.
    #[error("wrong number of values")]
    ValueCount,
    /// A definition whose register is not a constant.
    #[error("not a constant register")]
    NotAConstant,
    /// An invalid new name, or an undefined one.
    #[error("misused name")]
    Name,
    /// A program without `END`.
    #[error("missing end")]
    MissingEnd,
    /// An unknown `OPTION`.
    #[error("unknown option")]
    UnknownOption,
    /// An unknown suffix of `dcl`.
    #[error("unknown declaration")]
    UnknownUsage,
}

impl ErrorKind {
    /// The code in diagnostics, for example `asm::unknown_instruction`.
    pub fn code(self) -> String {
        format!("asm::{}", self.to_string().replace(' ', "_"))
    }
}

/// A syntax error.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{kind}: expected {expected}, found {found}")]
pub struct SyntaxError {
    /// Kind of the error.
    pub kind: ErrorKind,
    /// Location, in bytes of the text.
    pub span: Span,
    /// The expected input.
    pub expected: String,
    /// The input found.
    pub found: String,
    /// Advice.
    pub help: String,
}

impl SyntaxError {
    pub(super) fn new(
        kind: ErrorKind,
        span: Span,
        expected: impl Into<String>,
        found: impl Into<String>,
        help: impl Into<String>,
    ) -> Self {
        Self { kind, span, expected: expected.into(), found: found.into(), help: help.into() }
    }
}

impl Diagnostic for SyntaxError {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(self.kind.code()))
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(&self.help))
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let label = LabeledSpan::new_with_span(Some(self.kind.to_string()), self.span);
        Some(Box::new(std::iter::once(label)))
    }
}

/// All syntax errors of a text; never empty.
///
/// When displayed or returned from `main`, it quotes the line of each error with advice. For colours and labels, render
/// each error with the text (`miette::Report::new(error).with_source_code(NamedSource::new(name, text))`).
#[derive(Clone, PartialEq, Eq, thiserror::Error, Diagnostic)]
#[diagnostic(code("asm::syntax"))]
pub struct AssembleErrors {
    /// The errors in the order of the text.
    pub errors: Vec<SyntaxError>,
    /// The text; empty if it exceeds [`super::MAX_TEXT`].
    pub text: ProgramText,
}

impl AssembleErrors {
    /// Creates the list without its text, which the caller adds.
    pub(super) fn new(errors: Vec<SyntaxError>) -> Self {
        Self { errors, text: ProgramText::default() }
    }
}

impl fmt::Display for AssembleErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.errors.len() {
            1 => f.write_str("the program has a syntax error")?,
            n => write!(f, "the program has {n} syntax errors")?,
        }
        let placed = |e: &SyntaxError| PlacedMessage { span: e.span, message: e.to_string(), help: e.help.clone() };
        self.text.write_messages(f, self.errors.iter().map(placed))
    }
}

/// Same as `Display`, because a `main` that returns the errors prints this.
impl fmt::Debug for AssembleErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

pub(super) type Parsed<T> = Result<T, SyntaxError>;

/// Quotes text for error messages: in backticks, truncated to 40 characters.
pub(super) fn quote(text: &str) -> String {
    match text.char_indices().nth(40) {
        Some((cut, _)) => format!("`{}...`", text[..cut].escape_debug()),
        None => format!("`{}`", text.escape_debug()),
    }
}
