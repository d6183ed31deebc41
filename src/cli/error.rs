//! How errors look on the terminal, in a log and to a machine.

use std::{
    io::{self, IsTerminal as _, Write as _},
    path::{Path, PathBuf},
};

use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme, JSONReportHandler, MietteHandlerOpts, Report};

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
    /// A file that cannot be read.
    #[error("`{}` cannot be read", path.display())]
    #[diagnostic(
        code(crossbar::unreadable),
        help("check the path: it is taken from the folder the program was started in")
    )]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A folder or file that cannot be written.
    #[error("`{}` cannot be written", path.display())]
    #[diagnostic(
        code(crossbar::unwritable),
        help("name a folder that you may write to; nothing was left half-written")
    )]
    Unwritable {
        /// The file or folder.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
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
    /// For `map_err` on reading `path`.
    pub fn unreadable(path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_owned();
        move |source| Self::Unreadable { path, source }
    }

    /// For `map_err` on writing `path`.
    pub fn unwritable(path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_owned();
        move |source| Self::Unwritable { path, source }
    }

    /// Options that do not go together.
    pub fn usage(what: impl Into<String>, help: impl Into<String>) -> Self {
        Self::Usage { what: what.into(), help: help.into() }
    }
}

/// Colours and box drawing on a terminal; plain text of fixed width anywhere else.
pub(super) fn install_renderer() {
    let terminal = io::stderr().is_terminal();
    // Fails only if a hook is there already.
    miette::set_hook(Box::new(move |_| {
        if terminal {
            Box::new(MietteHandlerOpts::new().build())
        } else {
            Box::new(
                GraphicalReportHandler::new_themed(GraphicalTheme::none()).with_width(PLAIN_WIDTH).with_links(false),
            )
        }
    }))
    .ok();
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

/// Whether the error is only that nobody reads the output any more.
pub(super) fn reader_left(report: &Report) -> bool {
    report.downcast_ref::<OutputError>().is_some_and(|error| error.0.kind() == io::ErrorKind::BrokenPipe)
}
