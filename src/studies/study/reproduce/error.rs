//! Errors of the reproduction.

use std::fmt::Display;

use refsim::device::Profile;
use refsim::timing::TimingError;

use crate::study::StudyError;

/// Help for errors that are bugs of the program, not of its input.
const BUG: &str = "this is a bug: please report it with the command line";

/// Error for data of the papers' printed figures that is malformed, or that lacks a figure.
pub(super) fn papers_error(reason: &str) -> StudyError {
    StudyError::new("reproduce::papers", format!("printed figures of the papers: {reason}")).with_help(BUG)
}

pub(super) trait RunResult<T> {
    /// Converts a failure on a device to an entry's error: a machine rejects a draw, or a program does not assemble.
    fn on(self, device: &str) -> Result<T, StudyError>;
}

impl<T, E: Display> RunResult<T> for Result<T, E> {
    fn on(self, device: &str) -> Result<T, StudyError> {
        self.map_err(|reason| {
            let what = format!("a run of this entry failed on `{device}`: {reason}");
            StudyError::new("reproduce::run", what).with_help(BUG)
        })
    }
}

/// Error of a timing model that lacks a value.
pub(super) fn no_time(error: TimingError) -> StudyError {
    StudyError::coded("reproduce::timing", error)
}

/// Returns a value of a profile that an entry requires; fails if the profile lacks it.
pub(super) fn figure(profile: &Profile, name: &'static str, value: Option<u64>) -> Result<f64, StudyError> {
    let missing = || {
        let what = format!("device `{}` has no figure `{name}`, which this entry needs", profile.name);
        StudyError::new("reproduce::no_figure", what)
    };
    Ok(value.ok_or_else(missing)? as f64)
}
