//! Errors on the terminal, in a log and as JSON.

use std::ffi::OsString;
use std::fmt;
use std::io::{self, IsTerminal as _, Write as _};
use std::sync::atomic::{AtomicBool, Ordering};

use clap::error::ContextKind;
use miette::{
    Diagnostic, GraphicalReportHandler, GraphicalTheme, JSONReportHandler, MietteDiagnostic, MietteHandlerOpts, Report,
    ReportHandler, Severity,
};

use refsim::device::DeviceError;
use textwrap::WordSplitter::NoHyphenation;

use super::shown::{MAX_SHOWN, ShownError};
use crate::case::{CaseError, meant};
use crate::error::InputError;
use crate::io::WriteError;
use crate::report::visible::{visible, visible_json, visible_line};

/// Width of tables and errors in a file or pipe, so that the text does not depend on a terminal.
pub(super) const PLAIN_WIDTH: usize = 100;

/// `true` with `--json`: errors and warnings are JSON.
static AS_JSON: AtomicBool = AtomicBool::new(false);

pub(super) fn as_json() {
    AS_JSON.store(true, Ordering::Relaxed);
}

/// Standard output could not be written.
#[derive(Debug, thiserror::Error, Diagnostic)]
#[error("standard output cannot be written")]
#[diagnostic(code(crossbar::output))]
pub struct OutputError(#[from] io::Error);

/// Invalid input found by a command, or termination by a signal; modules have their own errors.
#[non_exhaustive]
#[derive(Debug, thiserror::Error, Diagnostic)]
pub enum Problem {
    /// A file or folder that cannot be written; no incomplete file remains.
    #[error(transparent)]
    #[diagnostic(code(crossbar::unwritable))]
    Unwritable(#[from] WriteError),
    /// Input that a module rejects.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Input(#[from] InputError),
    /// Options that do not go together.
    #[error("{what}")]
    #[diagnostic(code(crossbar::usage), help("{help}"))]
    Usage {
        /// Description of the conflict.
        what: String,
        /// Advice for the user.
        help: String,
    },
}

impl Problem {
    /// Error about options that conflict.
    pub fn usage(what: impl Into<String>, help: impl Into<String>) -> Self {
        Self::Usage { what: what.into(), help: help.into() }
    }
}

/// Adds a suggested name to a report about a device; the emulator's error only lists all names.
fn suggested(report: Report) -> Report {
    let error = match (report.downcast_ref::<DeviceError>(), report.downcast_ref::<CaseError>()) {
        (Some(error), _) | (_, Some(CaseError::Device(error))) => error.clone(),
        _ => return report,
    };
    let meant = meant(&error);
    if meant.is_empty() {
        return report;
    }
    let help = error.help().map(|help| help.to_string()).unwrap_or_default();
    let mut suggestion = MietteDiagnostic::new(error.to_string()).with_help(format!("{meant}{help}").trim_end());
    suggestion.code = error.code().map(|code| code.to_string());
    // Keeps the contexts that were added to the error.
    let (outer, inner) = (report.to_string(), error.to_string());
    if outer == inner { suggestion.into() } else { Report::from(suggestion).wrap_err(outer) }
}

/// Colors and box drawing on a terminal; otherwise plain text of fixed width. No name is broken at a hyphen.
fn handler(terminal: bool) -> Box<dyn ReportHandler> {
    if terminal {
        Box::new(MietteHandlerOpts::new().word_splitter(NoHyphenation).build())
    } else {
        let plain = GraphicalReportHandler::new_themed(GraphicalTheme::none());
        Box::new(plain.with_width(PLAIN_WIDTH).with_links(false).with_word_splitter(NoHyphenation))
    }
}

/// Formats a diagnostic as text for a terminal or a log, with the first few errors of each list.
fn render(diagnostic: &dyn Diagnostic, terminal: bool) -> String {
    struct Rendered(ShownError, Box<dyn ReportHandler>);
    impl fmt::Display for Rendered {
        fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            self.1.debug(&self.0, f)
        }
    }
    let shown = ShownError::new(diagnostic, MAX_SHOWN);
    let more = shown.left_out();
    let mut text = Rendered(shown, handler(terminal)).to_string().trim_end().to_owned();
    if more > 0 {
        text.push_str(&format!("\n\n... and {more} more: `--json` lists all"));
    }
    text
}

pub(super) fn render_finding(finding: &dyn Diagnostic) -> String {
    render(finding, io::stdout().is_terminal())
}

pub(super) fn print(report: Report) {
    write_report("Error", &suggested(report));
}

/// Writes a report to standard error; failures are ignored.
fn write_report(severity: &str, report: &Report) {
    let text = if AS_JSON.load(Ordering::Relaxed) {
        let mut text = String::new();
        // Writing to a string cannot fail.
        JSONReportHandler::new().render_report(&mut text, report.as_ref()).ok();
        visible_json(&text).into_owned()
    } else {
        format!("{severity}: {}", render(report.as_ref(), io::stderr().is_terminal()))
    };
    writeln!(io::stderr().lock(), "{}", text.trim_end()).ok();
}

/// Writes a warning to standard error.
pub(super) fn warn(warning: impl Diagnostic + Send + Sync + 'static) {
    write_report("Warning", &Report::new(warning));
}

/// Writes a warning without source text to standard error, as one line.
pub(super) fn warn_line(text: &str) {
    if AS_JSON.load(Ordering::Relaxed) {
        return warn(MietteDiagnostic::new(text).with_severity(Severity::Warning));
    }
    // A failed write is ignored.
    writeln!(io::stderr().lock(), "warning: {}", visible_line(text)).ok();
}

/// A usage error without the parser's advice to write an unknown option as a value; no command has such values.
pub(super) fn without_tip(mut error: clap::Error) -> clap::Error {
    if error.get(ContextKind::Suggested).is_some_and(|tips| tips.to_string().contains("as a value")) {
        error.remove(ContextKind::Suggested);
    }
    error
}

fn usage_problem(error: &clap::Error) -> Problem {
    let text = visible(&error.render().to_string()).into_owned();
    let (what, help) = text.split_once("\n\n").unwrap_or((&text, ""));
    let joined = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    Problem::usage(joined(what.trim_start_matches("error: ")), joined(help))
}

/// Writes the error in the arguments, or the requested help; as JSON if `--json` is among them. A message that quotes
/// hidden characters is plain, and escapes them.
pub(super) fn print_usage(error: &clap::Error, arguments: &[OsString]) -> io::Result<()> {
    if error.use_stderr() && arguments.iter().any(|argument| argument == "--json") {
        as_json();
        print(usage_problem(error).into());
        return Ok(());
    }
    match arguments.iter().all(|argument| argument.to_str().is_some_and(|text| visible_line(text) == text)) {
        true => error.print(),
        false => writeln!(io::stderr().lock(), "{}", visible(&error.render().to_string()).trim_end()),
    }
}

pub(super) fn reader_left(report: &Report) -> bool {
    report.downcast_ref::<OutputError>().is_some_and(|error| error.0.kind() == io::ErrorKind::BrokenPipe)
}
