//! The error type of all modules for invalid input.

use std::error::Error;
use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

pub use crate::{ensure, input_error};

/// A file and, where known, the line of the error, counted from 1.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FilePlace {
    /// The file.
    pub path: PathBuf,
    /// The line.
    pub line: Option<usize>,
}

impl FilePlace {
    /// A line of a file.
    pub fn line(path: &Path, line: usize) -> Self {
        Self { path: path.into(), line: Some(line) }
    }
}

impl From<&Path> for FilePlace {
    fn from(path: &Path) -> Self {
        Self { path: path.into(), line: None }
    }
}

impl fmt::Display for FilePlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.path.display())?;
        self.line.map_or(Ok(()), |line| write!(f, ":{line}"))
    }
}

/// An argument that a function does not accept. The message states the expected and the found value.
///
/// Two errors are equal if their codes and displayed texts are equal.
#[derive(Clone)]
pub struct InputError(Box<ErrorParts>);

#[derive(Clone, Debug)]
struct ErrorParts {
    code: &'static str,
    message: String,
    help: Option<String>,
    place: Option<FilePlace>,
    cause: Option<Cause>,
}

#[derive(Clone, Debug)]
enum Cause {
    /// Cause of an error that has a message of its own; `source` returns this cause.
    Source(Arc<dyn Error + Send + Sync>),
    /// Error whose text is the message. `source` returns the source of this error, so that no text is shown twice.
    Shown(Arc<dyn Error + Send + Sync>),
}

impl InputError {
    /// Creates an error with a machine-readable code: empty if the caller sets it with [`Self::coded`]. [`input_error`]
    /// formats the message.
    pub fn new(code: &'static str, message: impl Into<String>) -> Self {
        Self(Box::new(ErrorParts { code, message: message.into(), help: None, place: None, cause: None }))
    }

    /// Wraps another error, whose message is shown unchanged.
    pub fn of(code: &'static str, error: impl Error + Send + Sync + 'static) -> Self {
        let mut shown = Self::new(code, error.to_string());
        shown.0.cause = Some(Cause::Shown(Arc::new(error)));
        shown
    }

    /// Replaces the code by the code of the step that needed the input.
    pub fn coded(mut self, code: &'static str) -> Self {
        self.0.code = code;
        self
    }

    /// Adds advice to the user.
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.0.help = Some(help.into());
        self
    }

    /// Adds the file, or a line of it, and puts it at the start of the message.
    pub fn at(mut self, place: impl Into<FilePlace>) -> Self {
        self.0.place = Some(place.into());
        self
    }

    /// Adds the error that caused this one.
    pub fn with_source(mut self, source: impl Error + Send + Sync + 'static) -> Self {
        self.0.cause = Some(Cause::Source(Arc::new(source)));
        self
    }

    /// The machine-readable code; empty if there is none.
    pub fn error_code(&self) -> &'static str {
        self.0.code
    }

    /// Advice to the user.
    pub fn advice(&self) -> Option<&str> {
        self.0.help.as_deref()
    }
}

impl fmt::Debug for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&self.0, f)
    }
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.place.as_ref().map_or(Ok(()), |place| write!(f, "{place}: "))?;
        f.write_str(&self.0.message)
    }
}

impl PartialEq for InputError {
    fn eq(&self, other: &Self) -> bool {
        (self.0.code, &self.0.message, &self.0.place) == (other.0.code, &other.0.message, &other.0.place)
    }
}

impl Error for InputError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self.0.cause.as_ref()? {
            Cause::Source(error) => Some(&**error),
            Cause::Shown(error) => error.source(),
        }
    }
}

#[cfg(feature = "miette")]
impl miette::Diagnostic for InputError {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        (!self.0.code.is_empty()).then(|| Box::new(self.0.code) as _)
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.0.help.as_ref().map(|help| Box::new(help) as _)
    }
}

/// Creates an [`InputError`] from a code, a message as for [`format!`], and advice after `; help`. Without a code, the
/// message is the only argument.
///
/// ```
/// use crossbar_base::error::input_error;
///
/// let found = 7;
/// let error = input_error!("room::angle" => "expected an even number, found {found}"; help "take {}", found + 1);
/// assert_eq!((error.to_string().as_str(), error.advice()), ("expected an even number, found 7", Some("take 8")));
/// ```
#[macro_export]
macro_rules! input_error {
    ($code:literal => $message:literal $(, $value:expr)* $(,)? $(; help $($help:tt)+)?) => {
        $crate::error::InputError::new($code, format!($message $(, $value)*))$(.with_help(format!($($help)+)))?
    };
    ($message:literal $(, $value:expr)* $(,)? $(; help $($help:tt)+)?) => {
        $crate::input_error!("" => $message $(, $value)* $(; help $($help)+)?)
    };
}

/// Returns an [`input_error`] unless the first argument, a condition, is true.
#[macro_export]
macro_rules! ensure {
    ($condition:expr, $($error:tt)+) => {
        match $condition {
            true => {}
            false => return Err($crate::input_error!($($error)+)),
        }
    };
}
