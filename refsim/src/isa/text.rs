//! The source text of a program, for messages that quote it.

use std::fmt;
use std::sync::Arc;

use super::Span;

/// Maximum length of a quoted part of a line, in characters.
const MAX_QUOTED: usize = 100;
/// Maximum number of problems quoted in one message.
const MAX_PROBLEMS: usize = 20;

/// The source text of a program; empty if the program was not assembled from text.
///
/// All texts compare equal, as [`Span`]s do, so that programs that differ only in layout are equal.
#[derive(Clone, Default)]
pub struct ProgramText(Arc<str>);

/// A message about a position in a program text.
pub(crate) struct PlacedMessage {
    pub(crate) span: Span,
    pub(crate) message: String,
    pub(crate) help: String,
}

impl ProgramText {
    /// Wraps a text.
    pub fn new(text: &str) -> Self {
        Self(text.into())
    }

    /// The text.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// Line and column of a byte of the text, both from 1, columns in characters; `None` outside the text.
    pub fn position(&self, byte: u32) -> Option<(usize, usize)> {
        let before = self.0.get(..byte as usize)?;
        let (line, start) = match before.rfind('\n') {
            Some(end) => (before.matches('\n').count() + 1, end + 1),
            None => (1, 0),
        };
        Some((line, before[start..].trim_start_matches('\u{feff}').chars().count() + 1))
    }

    /// Writes messages, each with its position, the quoted line with the position marked, and the help. Messages beyond
    /// [`MAX_PROBLEMS`] are only counted.
    pub(crate) fn write_messages(
        &self,
        f: &mut fmt::Formatter<'_>,
        messages: impl ExactSizeIterator<Item = PlacedMessage>,
    ) -> fmt::Result {
        let rest = messages.len().saturating_sub(MAX_PROBLEMS);
        for PlacedMessage { span, message, help } in messages.take(MAX_PROBLEMS) {
            match self.position(span.start).filter(|_| !self.0.is_empty()) {
                Some((line, column)) => {
                    write!(f, "\nline {line}, column {column}: {message}")?;
                    self.write_line(f, span, column)?;
                }
                None => write!(f, "\n{message}")?,
            }
            write!(f, "\n    help: {help}")?;
        }
        if rest > 0 {
            write!(f, "\nand {rest} more")?;
        }
        Ok(())
    }

    /// Writes the line of a span, and marks the part that the span covers on the line below.
    fn write_line(&self, f: &mut fmt::Formatter<'_>, span: Span, column: usize) -> fmt::Result {
        let text = &self.0;
        let start = text[..span.start as usize].rfind('\n').map_or(0, |end| end + 1);
        let line = text[start..].lines().next().unwrap_or_default().trim_start_matches('\u{feff}');
        let plain = |c: char| if c.is_control() { ' ' } else { c };
        let quoted: String = line.chars().take(MAX_QUOTED).map(plain).collect();
        // A statement may continue on the next lines; only its first line is marked.
        let covered = text.get(span.start as usize..span.end as usize).and_then(|part| part.lines().next());
        let marks = covered.unwrap_or_default().chars().count().max(1);
        if quoted.trim().is_empty() || column > MAX_QUOTED {
            return Ok(());
        }
        let marks = "^".repeat(marks.min(MAX_QUOTED + 1 - column));
        write!(f, "\n    {}\n    {:space$}{marks}", quoted.trim_end(), "", space = column - 1)
    }
}

impl fmt::Debug for ProgramText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "ProgramText({} bytes)", self.0.len())
    }
}

impl PartialEq for ProgramText {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}
impl Eq for ProgramText {}
impl std::hash::Hash for ProgramText {
    fn hash<H: std::hash::Hasher>(&self, _: &mut H) {}
}
