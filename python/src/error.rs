//! Library errors as `ValueError`: the message, its causes, and advice.

use std::error::Error;

use miette::Diagnostic;
use pyo3::PyErr;
use pyo3::exceptions::PyValueError;

/// A `ValueError` with a message.
pub(crate) fn value_error(sentence: impl Into<String>) -> PyErr {
    PyValueError::new_err(sentence.into())
}

/// An error of the library: its message, the messages of its causes and of listed errors, and its help.
pub(crate) fn refused(error: &dyn Diagnostic) -> PyErr {
    let mut text = error.to_string();
    let mut cause: Option<&(dyn Error + 'static)> = error.source();
    while let Some(inner) = cause {
        let sentence = inner.to_string();
        if !text.ends_with(&sentence) {
            text += &format!(": {sentence}");
        }
        cause = inner.source();
    }
    for related in error.related().into_iter().flatten() {
        text += &format!("\n  {related}{}", help(related, ": "));
    }
    text += &help(error, "\n");
    value_error(text)
}

fn help(error: &dyn Diagnostic, before: &str) -> String {
    error.help().map(|help| format!("{before}{help}")).unwrap_or_default()
}
