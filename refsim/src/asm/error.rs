//! What can be wrong with a program text.

use crate::isa::Span;
use miette::{Diagnostic, LabeledSpan};
use std::fmt;

/// The kind of a syntax error.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
pub enum ErrorKind {
    /// The text exceeds [`super::MAX_TEXT`].
    #[error("program text too long")]
    TextTooLong,
    /// The text has more statements than [`super::MAX_STATEMENTS`].
    #[error("too many statements")]
    TooManyStatements,
    /// The list of errors was cut at [`super::MAX_ERRORS`].
    #[error("too many errors")]
    TooManyErrors,
    /// A `/*` without its `*/`.
    #[error("unclosed comment")]
    UnclosedComment,
    /// The text doesn't start with a version token.
    #[error("missing shader version")]
    MissingVersion,
    /// The version token names no version that we know.
    #[error("unknown shader version")]
    UnknownVersion,
    /// A version token after the first.
    #[error("second shader version")]
    RepeatedVersion,
    /// A token that can start or continue no statement.
    #[error("misplaced text")]
    UnexpectedToken,
    /// No version has such an instruction.
    #[error("unknown instruction")]
    UnknownOpcode,
    /// The instruction has no such modifier or comparison.
    #[error("unknown instruction modifier")]
    UnknownInstructionModifier,
    /// A modifier twice, or two modifiers of a kind.
    #[error("repeated modifier")]
    RepeatedModifier,
    /// `_sat` and its kin on an instruction that writes nothing.
    #[error("modifier without a destination")]
    ModifierWithoutDestination,
    /// `setp` without `_gt` and so on.
    #[error("missing comparison")]
    MissingComparison,
    /// Too few or too many operands.
    #[error("wrong number of operands")]
    OperandCount,
    /// Something else stands where an operand should.
    #[error("malformed operand")]
    MalformedOperand,
    /// No version has such a register.
    #[error("unknown register")]
    UnknownRegister,
    /// A register that needs a number and has none.
    #[error("missing register number")]
    MissingRegisterNumber,
    /// A register number or usage index beyond all reason.
    #[error("register number out of range")]
    RegisterNumber,
    /// A swizzle that isn't one to four letters of one set.
    #[error("malformed swizzle")]
    Swizzle,
    /// A mask with repeated, unordered or foreign letters.
    #[error("malformed write mask")]
    Mask,
    /// No such source modifier.
    #[error("unknown source modifier")]
    UnknownSourceModifier,
    /// Source modifiers that cannot stand together.
    #[error("source modifiers that do not combine")]
    SourceModifierClash,
    /// A source modifier on a destination.
    #[error("source modifier on a destination")]
    ModifierOnDestination,
    /// Malformed text between brackets.
    #[error("malformed relative address")]
    RelativeAddress,
    /// Malformed text between the parentheses in front of an instruction.
    #[error("malformed predicate")]
    Predicate,
    /// `+` or a predicate in front of something that takes none.
    #[error("misplaced prefix")]
    MisplacedPrefix,
    /// A value that is no number, integer or truth value.
    #[error("malformed value")]
    MalformedValue,
    /// A value that the constant cannot hold.
    #[error("value out of range")]
    ValueRange,
    /// Too few or too many values in a `def`.
    #[error("wrong number of values")]
    ValueCount,
    /// A definition of something that is no constant register.
    #[error("not a constant register")]
    NotAConstant,
    /// A name that cannot be given, or one that nobody gave.
    #[error("misused name")]
    Name,
    /// A program without its `END`.
    #[error("missing end")]
    MissingEnd,
    /// An `OPTION` that changes what a program means and is not known.
    #[error("unknown option")]
    UnknownOption,
    /// An unknown suffix of `dcl`.
    #[error("unknown declaration")]
    UnknownUsage,
}

impl ErrorKind {
    /// The kind's name as it stands in diagnostics, `asm::unknown_instruction` for example.
    pub fn code(self) -> String {
        format!("asm::{}", self.to_string().replace(' ', "_"))
    }
}

/// One syntax error.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{kind}: expected {expected}, found {found}")]
pub struct SyntaxError {
    /// What kind of error it is.
    pub kind: ErrorKind,
    /// Where it stands, in bytes of the text.
    pub span: Span,
    /// What would have been right.
    pub expected: String,
    /// What stands there.
    pub found: String,
    /// What to do.
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

/// Every syntax error of a text; never empty.
///
/// No source is attached. To show the text, wrap the errors with its name and contents
/// (`miette::Report::new(errors).with_source_code(NamedSource::new(name, text))`).
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error, Diagnostic)]
#[error("{}", summary(.errors))]
#[diagnostic(code("asm::syntax"))]
pub struct AssembleErrors {
    /// The errors in the order of the text.
    #[related]
    pub errors: Vec<SyntaxError>,
}

fn summary(errors: &[SyntaxError]) -> String {
    match errors.len() {
        1 => "the program has a syntax error".to_owned(),
        n => format!("the program has {n} syntax errors"),
    }
}

/// The result of reading one part of a statement.
pub(super) type Parsed<T> = Result<T, SyntaxError>;

/// A piece of the text as error messages show it: in backticks, cut at 40 characters.
pub(super) fn quote(text: &str) -> String {
    match text.char_indices().nth(40) {
        Some((cut, _)) => format!("`{}...`", text[..cut].escape_debug()),
        None => format!("`{}`", text.escape_debug()),
    }
}
