//! The one error of all studies.

use std::error::Error;
use std::fmt;

use miette::{Diagnostic, LabeledSpan, SourceCode};
use refsim::device::DeviceError;

use crate::error::InputError;
use crate::shader::ShaderError;

/// Error of a study: its own sentence or a library's error, with a code for programs and advice.
///
/// A library's error that is a diagnostic is shown unchanged. Others have a code that names the failed step of the
/// study. [`Self::downcast_ref`] returns the library's error.
#[derive(Debug)]
pub struct StudyError(Box<ErrorParts>);

#[derive(Debug, Default)]
struct ErrorParts {
    code: Option<&'static str>,
    sentence: Option<String>,
    help: Option<String>,
    cause: Option<Cause>,
}

/// Error of a library.
#[derive(Debug)]
enum Cause {
    Error(Box<dyn Error + Send + Sync>),
    Diagnostic(Box<dyn Diagnostic + Send + Sync>),
}

impl Cause {
    fn error(&self) -> &(dyn Error + 'static) {
        match self {
            Self::Error(error) => &**error,
            Self::Diagnostic(error) => &**error,
        }
    }
}

impl StudyError {
    /// An error that the study itself found: the sentence states the location, the expected and the found value.
    pub fn new(code: &'static str, sentence: impl Into<String>) -> Self {
        Self(Box::new(ErrorParts { code: Some(code), sentence: Some(sentence.into()), ..ErrorParts::default() }))
    }

    /// An error about options that conflict, with the code `crossbar::usage`.
    pub fn usage(sentence: impl Into<String>, help: impl Into<String>) -> Self {
        Self::new("crossbar::usage", sentence).with_help(help)
    }

    /// A library's error with its own message, under a code of the study.
    pub fn coded(code: &'static str, error: impl Error + Send + Sync + 'static) -> Self {
        let cause = Some(Cause::Error(Box::new(error)));
        Self(Box::new(ErrorParts { code: Some(code), cause, ..ErrorParts::default() }))
    }

    /// A library's error, shown unchanged.
    pub fn diagnostic(error: impl Diagnostic + Send + Sync + 'static) -> Self {
        Self(Box::new(ErrorParts { cause: Some(Cause::Diagnostic(Box::new(error))), ..ErrorParts::default() }))
    }

    /// Adds the advice.
    #[must_use]
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.0.help = Some(help.into());
        self
    }

    /// Adds the error that caused this one.
    #[must_use]
    pub fn with_source(mut self, source: impl Error + Send + Sync + 'static) -> Self {
        self.0.cause = Some(Cause::Error(Box::new(source)));
        self
    }

    /// The library's error, if it has this type.
    pub fn downcast_ref<E: Error + 'static>(&self) -> Option<&E> {
        self.0.cause.as_ref()?.error().downcast_ref()
    }

    fn shown(&self) -> Option<&(dyn Diagnostic + Send + Sync)> {
        match &self.0.cause {
            Some(Cause::Diagnostic(error)) => Some(&**error),
            _ => None,
        }
    }
}

impl fmt::Display for StudyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (&self.0.sentence, &self.0.cause) {
            (Some(sentence), _) => f.write_str(sentence),
            (None, Some(cause)) => fmt::Display::fmt(cause.error(), f),
            (None, None) => Ok(()),
        }
    }
}

impl Error for StudyError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        let cause = self.0.cause.as_ref()?.error();
        // Without a sentence the cause is displayed, and the chain starts after it.
        if self.0.sentence.is_some() { Some(cause) } else { cause.source() }
    }
}

impl Diagnostic for StudyError {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.0.code.map(|code| Box::new(code) as _).or_else(|| self.shown()?.code())
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.0.help.as_ref().map(|help| Box::new(help) as _).or_else(|| self.shown()?.help())
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.shown()?.source_code()
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        self.shown()?.labels()
    }

    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        self.shown()?.related()
    }
}

/// Converts errors of libraries: diagnostics are shown unchanged, others under a code, with help if given.
macro_rules! library_errors {
    ($($error:ty $(=> $code:literal $(, $help:literal)?)?;)*) => {
        $(impl From<$error> for $crate::study::StudyError {
            fn from(error: $error) -> Self {
                $crate::study::error::library_errors!(@ error $($code $($help)?)?)
            }
        })*
    };
    (@ $error:ident) => { Self::diagnostic($error) };
    (@ $error:ident $code:literal) => { Self::coded($code, $error) };
    (@ $error:ident $code:literal $help:literal) => { Self::coded($code, $error).with_help($help) };
}
pub(in crate::study) use library_errors;

library_errors! {
    DeviceError;
    InputError;
    ShaderError;
}
