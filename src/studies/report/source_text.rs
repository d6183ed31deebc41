//! Named text for error messages, with an index of its lines for fast look-up.

use std::ops::Range;

use miette::{MietteError, MietteSpanContents, SourceCode, SourceSpan, SpanContents};

/// Text with its name and an index of its lines. Lines end with a line feed; columns count characters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourceText {
    name: String,
    text: String,
    starts: Vec<usize>,
    /// `true` if the text is ASCII: columns then equal bytes.
    ascii: bool,
}

impl SourceText {
    /// Creates a text with its name in messages.
    pub fn new(name: impl Into<String>, text: impl Into<String>) -> Self {
        let text = text.into();
        let starts = std::iter::once(0).chain(text.match_indices('\n').map(|(end, _)| end + 1)).collect();
        Self { name: name.into(), ascii: text.is_ascii(), starts, text }
    }

    /// Name in messages.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Index, from 0, of the line that contains a byte; the end of the text belongs to the last line.
    pub fn line_of(&self, byte: usize) -> usize {
        self.starts.partition_point(|&start| start <= byte).saturating_sub(1)
    }

    /// Byte range of a line, from 0, including its end.
    pub fn line_range(&self, line: usize) -> Range<usize> {
        let place = |line: usize| self.starts.get(line).copied().unwrap_or(self.text.len());
        place(line)..place(line + 1)
    }

    /// Column, from 0, of a byte in its line.
    pub fn column_of(&self, byte: usize) -> usize {
        let start = self.line_range(self.line_of(byte)).start;
        let end = self.text.floor_char_boundary(byte);
        if self.ascii { end - start } else { self.text[start.min(end)..end].chars().count() }
    }
}

impl SourceCode for SourceText {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let (start, end) = (span.offset(), span.offset().saturating_add(span.len()));
        if end > self.text.len() {
            return Err(MietteError::OutOfBounds);
        }
        let first = self.line_of(start).saturating_sub(before);
        // The last byte of the span decides, not the byte after it.
        let last = self.line_of(end.saturating_sub(1).max(start)).saturating_add(after);
        let from = if before == 0 { start } else { self.line_range(first).start };
        let to = if after == 0 { end } else { self.line_range(last).end };
        let column = if before == 0 { self.column_of(start) } else { 0 };
        let data = &self.text.as_bytes()[from..to];
        let lines = last.min(self.starts.len() - 1) - first + 1;
        let at = (from, to - from).into();
        Ok(Box::new(MietteSpanContents::new_named(self.name.clone(), data, at, first, column, lines)))
    }
}
