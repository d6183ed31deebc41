//! Standard output, buffered.

use std::io::{self, BufWriter, Stdout, Write};

use miette::Diagnostic;
use serde::Serialize;

use super::{OutputError, error};
use crate::report::Table;
use crate::report::layout::wrapped;
use crate::report::visible::{visible, visible_json, visible_line};

/// Output of a command's findings.
#[derive(Debug)]
pub struct Out {
    stdout: BufWriter<Stdout>,
    json: bool,
    /// `true` after the reader closed the output, if the command only continues for its exit code.
    deaf: bool,
    outlive_reader: bool,
}

impl Out {
    /// Creates the standard output; `json` is the value of `--json`.
    pub(super) fn new(json: bool) -> Self {
        let stdout = BufWriter::with_capacity(1 << 16, io::stdout());
        Self { stdout, json, deaf: false, outlive_reader: false }
    }

    /// Returns `true` if the output is JSON.
    pub const fn json(&self) -> bool {
        self.json
    }

    /// Columns of text: the variable `COLUMNS`, otherwise the width of the terminal, otherwise [`error::PLAIN_WIDTH`].
    fn width() -> usize {
        let said =
            std::env::var("COLUMNS").ok().and_then(|columns| columns.parse().ok()).filter(|columns| *columns > 0);
        let terminal = || terminal_size::terminal_size_of(io::stdout()).map(|(width, _)| usize::from(width.0));
        said.or_else(terminal).unwrap_or(error::PLAIN_WIDTH)
    }

    /// From now on, a closed pipe does not end the command: it continues to its verdict.
    pub const fn outlive_reader(&mut self) {
        self.outlive_reader = true;
    }

    /// Writes text and a line end; hidden characters in the text are escaped, its line ends stay.
    pub fn line(&mut self, text: impl std::fmt::Display) -> Result<(), OutputError> {
        Ok(writeln!(self, "{}", visible(&text.to_string()))?)
    }

    /// Writes a sentence, wrapped at the terminal's width. Fails if standard output cannot be written.
    pub fn sentence(&mut self, text: impl std::fmt::Display) -> Result<(), OutputError> {
        self.line(wrapped(&visible_line(&text.to_string()), Self::width(), "  ").join("\n"))
    }

    /// Writes a table without its title, within the terminal's width, and notes about folded rows.
    pub fn table(&mut self, table: &Table) -> Result<(), OutputError> {
        self.line(table.text_within(Self::width()))?;
        table.notes().into_iter().try_for_each(|note| self.sentence(note))
    }

    /// Writes a table as JSON, or as text with sentences below it. Fails if standard output cannot be written.
    pub fn listing(&mut self, table: &Table, below: &[&str]) -> Result<(), OutputError> {
        if self.json {
            return self.document(&table.json());
        }
        self.table(table)?;
        if !below.is_empty() {
            self.line("")?;
        }
        below.iter().try_for_each(|text| self.sentence(text))
    }

    /// Writes a check's finding in the format of an error. Fails if standard output cannot be written.
    pub fn finding(&mut self, finding: &dyn Diagnostic) -> Result<(), OutputError> {
        let text = error::render_finding(finding);
        Ok(writeln!(self, "{text}")?)
    }

    /// Writes `value` as indented JSON and ends the line. Fails if standard output cannot be written.
    pub fn document(&mut self, value: &impl Serialize) -> Result<(), OutputError> {
        let text = serde_json::to_string_pretty(value).map_err(io::Error::from)?;
        Ok(writeln!(self, "{}", visible_json(&text))?)
    }

    fn forgive(&mut self, error: io::Error, done: usize) -> io::Result<usize> {
        if self.outlive_reader && error.kind() == io::ErrorKind::BrokenPipe {
            self.deaf = true;
            return Ok(done);
        }
        Err(error)
    }
}

impl Write for Out {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.deaf {
            return Ok(bytes.len());
        }
        self.stdout.write(bytes).or_else(|error| self.forgive(error, bytes.len()))
    }

    fn flush(&mut self) -> io::Result<()> {
        if self.deaf {
            return Ok(());
        }
        self.stdout.flush().or_else(|error| self.forgive(error, 0).map(drop))
    }
}
