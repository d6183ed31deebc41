//! How errors look on the terminal, in a log and to a machine.

use std::io::{self, IsTerminal as _, Write as _};

use miette::{
    Diagnostic, GraphicalReportHandler, GraphicalTheme, JSONReportHandler, MietteHandlerOpts, Report, ReportHandler,
};

use crate::io::atomic::WriteError;

/// Columns of an error that goes to a file or pipe, so that its text does not depend on a terminal.
const PLAIN_WIDTH: usize = 100;

/// Standard output could not be written.
#[derive(Debug, thiserror::Error, Diagnostic)]
#[error("standard output cannot be written")]
#[diagnostic(code(crossbar::output))]
pub struct OutputError(#[from] io::Error);

/// Bad input that a command found itself; the rooms bring errors of their own.
#[derive(Debug, thiserror::Error, Diagnostic)]
pub enum Problem {
    /// A file or folder that cannot be written; nothing of it was left behind.
    #[error(transparent)]
    #[diagnostic(code(crossbar::unwritable))]
    Unwritable(#[from] WriteError),
    /// Options that do not go together.
    #[error("{what}")]
    #[diagnostic(code(crossbar::usage), help("{help}"))]
    Usage {
        /// What is wrong.
        what: String,
        /// What to do.
        help: String,
    },
}

impl Problem {
    /// Options that do not go together.
    pub fn usage(what: impl Into<String>, help: impl Into<String>) -> Self {
        Self::Usage { what: what.into(), help: help.into() }
    }
}

/// Colours and box drawing on a terminal; plain text of fixed width anywhere else.
fn handler(terminal: bool) -> Box<dyn ReportHandler> {
    if terminal {
        Box::new(MietteHandlerOpts::new().build())
    } else {
        let plain = GraphicalReportHandler::new_themed(GraphicalTheme::none());
        Box::new(plain.with_width(PLAIN_WIDTH).with_links(false))
    }
}

/// Chooses how errors look on standard error.
pub(super) fn install_renderer() {
    let terminal = io::stderr().is_terminal();
    // Fails only if a hook is there already.
    miette::set_hook(Box::new(move |_| handler(terminal))).ok();
}

/// What a check found, as text for standard output.
pub(super) fn render_finding(finding: impl Diagnostic) -> String {
    struct Shown<D>(D, Box<dyn ReportHandler>);
    impl<D: Diagnostic> std::fmt::Display for Shown<D> {
        fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
            self.1.debug(&self.0, f)
        }
    }
    Shown(finding, handler(io::stdout().is_terminal())).to_string().trim_end().to_owned()
}

/// Writes the error to standard error: there is nowhere to complain if that fails.
pub(super) fn print(report: &Report, json: bool) {
    let mut text = String::new();
    if json {
        // Writing to a string cannot fail.
        JSONReportHandler::new().render_report(&mut text, report.as_ref()).ok();
    } else {
        text = format!("Error: {report:?}");
    }
    writeln!(io::stderr().lock(), "{}", text.trim_end()).ok();
}

/// Writes warnings to standard error, each once.
pub(super) fn print_warnings<W: Diagnostic + Clone + Send + Sync + 'static>(warnings: &[W], json: bool) {
    for warning in warnings {
        let report = Report::new(warning.clone());
        let mut text = String::new();
        if json {
            // Writing to a string cannot fail.
            JSONReportHandler::new().render_report(&mut text, report.as_ref()).ok();
        } else {
            text = format!("Warning: {report:?}");
        }
        writeln!(io::stderr().lock(), "{}", text.trim_end()).ok();
    }
}

/// Whether the error is only that nobody reads the output any more.
pub(super) fn reader_left(report: &Report) -> bool {
    report.downcast_ref::<OutputError>().is_some_and(|error| error.0.kind() == io::ErrorKind::BrokenPipe)
}
