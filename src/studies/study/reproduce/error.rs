//! Errors of the reproduction.

use refsim::device::{DeviceError, Profile};
use refsim::timing::TimingError;

use crate::names::did_you_mean;
use crate::ray_engine::EngineError;
use crate::report::ReportError;

/// Error of computing an entry.
#[non_exhaustive]
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum ReproduceError {
    /// No entry has this name.
    #[error("expected the name of an entry ({known}), found `{found}`")]
    #[diagnostic(
        code(reproduce::unknown),
        help("{}`crossbar reproduce --list` says what each is", did_you_mean(found, known.split(", ")))
    )]
    Unknown { found: String, known: String },
    /// A profile lacks a value that the paper's cost equation needs.
    #[error("device `{device}` has no figure `{figure}`, which this entry needs")]
    #[diagnostic(code(reproduce::no_figure))]
    NoFigure { device: String, figure: &'static str },
    /// The data of the papers' printed figures is malformed, or lacks a figure.
    #[error("printed figures of the papers: {reason}")]
    #[diagnostic(code(reproduce::papers), help("this is a bug: please report it with the command line"))]
    Papers { reason: String },
    /// A device is invalid.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Device(#[from] DeviceError),
    /// The Ray Engine failed.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Engine(#[from] EngineError),
    /// The timing model lacks a value.
    #[error(transparent)]
    #[diagnostic(code(reproduce::timing))]
    Timing(#[from] TimingError),
    /// A chart cannot be encoded.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Report(#[from] ReportError),
    /// A machine refuses a draw of an entry, or a program of an entry does not assemble.
    #[error("a run of this entry failed on `{device}`: {reason}")]
    #[diagnostic(code(reproduce::run), help("this is a bug: please report it with the command line"))]
    Run { device: String, reason: String },
}

/// Converts a value required by an entry, or returns the error for its absence.
pub(super) fn figure(profile: &Profile, name: &'static str, value: Option<u64>) -> Result<f64, ReproduceError> {
    let missing = || ReproduceError::NoFigure { device: profile.name.clone(), figure: name };
    Ok(value.ok_or_else(missing)? as f64)
}
