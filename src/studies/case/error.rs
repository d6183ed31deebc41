//! Errors and warnings of cases.

use std::{ops::Range, path::PathBuf, sync::Arc};

use miette::{Diagnostic, SourceSpan};

use refsim::{device::DeviceError, machine::MachineError};

use crate::error::InputError;
use crate::{
    names::did_you_mean_field,
    report::SourceText,
    shader::{ShaderError, ShaderWarning},
};

/// Text of a case with its name, cheap to share among errors.
pub(super) type Source = Arc<SourceText>;

/// Error of reading, binding or running a case.
#[non_exhaustive]
#[derive(Debug, thiserror::Error, Diagnostic)]
#[expect(missing_docs, reason = "the messages explain the fields")]
pub enum CaseError {
    /// The file is not TOML, or does not match the schema.
    #[error("{message}")]
    #[diagnostic(code(crossbar::case), help("{help}"))]
    Schema {
        message: String,
        help: String,
        #[source_code]
        source_code: Source,
        #[label("here")]
        span: Option<SourceSpan>,
    },
    #[error("`{}` cannot be read", path.display())]
    #[diagnostic(code(crossbar::case::unreadable), help("paths in a case are relative to the folder of the case file"))]
    Unreadable {
        path: PathBuf,
        source: std::io::Error,
        /// Text of the case, if a case names the file.
        #[source_code]
        source_code: Option<Source>,
        #[label("named here")]
        span: Option<SourceSpan>,
    },
    #[error("the case cannot be drawn: {0}")]
    #[diagnostic(
        code(crossbar::case::draw),
        help("change the case, or choose a device that can draw it: `crossbar devices`")
    )]
    Draw(Box<MachineError>),
    #[error("the case cannot be drawn: {error}")]
    #[diagnostic(code(crossbar::case::steps), help("{help}"))]
    StepBudget {
        error: Box<MachineError>,
        help: String,
        #[source_code]
        source_code: Source,
        #[label("one step too many")]
        span: SourceSpan,
    },
    /// A switch set in addition to those of the case is invalid.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Device(#[from] DeviceError),
    /// The file is too long or not text, or a picture of the result cannot be encoded.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Input(#[from] InputError),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Shader(#[from] ShaderError),
}

/// Warning: something runs, or may run, differently from the case's text.
#[non_exhaustive]
#[derive(Clone, Debug, thiserror::Error, Diagnostic)]
#[expect(missing_docs, reason = "the messages explain the fields")]
pub enum CaseWarning {
    #[error("{message}")]
    #[diagnostic(code(crossbar::case), severity(Warning), help("{help}"))]
    Case {
        message: String,
        help: String,
        #[source_code]
        source_code: Source,
        #[label("here")]
        span: SourceSpan,
    },
    /// Formats of instructions on the device that have no effect.
    #[error("`{device}` has {formats}, which {reason}")]
    #[diagnostic(code(crossbar::device), severity(Warning), help("{help}"))]
    Formats { device: String, formats: String, reason: &'static str, help: String },
    #[error(transparent)]
    #[diagnostic(transparent)]
    Shader(ShaderWarning),
}

impl From<MachineError> for CaseError {
    fn from(error: MachineError) -> Self {
        Self::Draw(Box::new(error))
    }
}

/// Creates errors with positions in the text of a case.
#[derive(Clone, Debug)]
pub(super) struct CaseText(pub(super) Source);

impl CaseText {
    pub(super) fn new(name: &str, text: &str) -> Self {
        Self(Arc::new(SourceText::new(name, text)))
    }

    pub(super) fn toml(&self, error: &toml::de::Error) -> CaseError {
        let message = error.message().trim_end().replace('\n', ", ");
        let message = message.replace("expected u32", &format!("expected a whole number from 0 to {}", u32::MAX));
        CaseError::Schema {
            help: format!("{}docs/cases.md describes the case format", did_you_mean_field(&message)),
            message,
            source_code: self.0.clone(),
            span: error.span().map(|span| self.clamp(span)),
        }
    }

    pub(super) fn wrong(&self, span: Range<usize>, message: impl Into<String>, help: impl Into<String>) -> CaseError {
        CaseError::Schema {
            message: message.into(),
            help: help.into(),
            source_code: self.0.clone(),
            span: Some(self.clamp(span)),
        }
    }

    pub(super) fn warning(&self, span: Range<usize>, message: String, help: String) -> CaseWarning {
        CaseWarning::Case { message, help, source_code: self.0.clone(), span: self.clamp(span) }
    }

    /// Creates the error for the unreadable file named by the text at `span`.
    pub(super) fn unreadable(&self, span: Range<usize>, path: PathBuf, source: std::io::Error) -> CaseError {
        CaseError::Unreadable { path, source, source_code: Some(self.0.clone()), span: Some(self.clamp(span)) }
    }

    /// Clamps a span to the text, so that it can be rendered.
    fn clamp(&self, span: Range<usize>) -> SourceSpan {
        let length = self.0.text().len();
        let start = span.start.min(length);
        (start, span.end.clamp(start, length) - start).into()
    }
}
