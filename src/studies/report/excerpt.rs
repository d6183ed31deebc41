//! Excerpts of a text for error messages: lines around labels. Long lines are truncated, hidden characters escaped.

use std::ops::Range;

use miette::{LabeledSpan, MietteError, MietteSpanContents, SourceCode, SourceSpan, SpanContents};

use unicode_width::UnicodeWidthChar as _;

use super::SourceText;
use super::visible::{is_hidden, visible_line};

/// Maximum columns of a line, including escapes but not the marks of truncation.
const WIDTH: usize = 80;
/// Minimum number of characters before a label in a truncated line.
const BEFORE: usize = 20;
const CUT: &str = "...";
/// Maximum number of lines shown of a label; a longer label shows only its first line.
const LINES: usize = 8;

/// Excerpt of a text in the form that a renderer of diagnostics needs, with its position in the text.
#[derive(Clone, Debug)]
pub struct Excerpt {
    piece: SourceText,
    first_line: usize,
    /// Per label: its position in the excerpt, and its column in the whole text, from 0, in characters.
    columns: Vec<(usize, usize)>,
}

impl Excerpt {
    /// Extracts the lines of `source` around `labels`; also returns the labels' positions in the excerpt. `None` if
    /// there are no labels, a label lies outside the text, or the text is not UTF-8.
    pub fn new(source: &dyn SourceCode, labels: &[LabeledSpan]) -> Option<(Self, Vec<LabeledSpan>)> {
        let low = labels.iter().map(LabeledSpan::offset).min()?;
        let high = labels.iter().map(|label| label.offset().saturating_add(label.len())).max()?;
        let whole = source.read_span(&(low, high - low).into(), 1, 1).ok()?;
        let (base, data) = (whole.span().offset(), std::str::from_utf8(whole.data()).ok()?);
        let mut lines = line_ranges(data);
        let starts = labels.iter().map(|label| (label.offset() - base, label.len()));
        let spans: Vec<Range<usize>> = starts.map(|(start, length)| clip(start..start + length, &lines)).collect();
        // The empty line after the last line end is shown only if a label is on it.
        let end = data.len();
        if lines.len() > 1 && lines.last() == Some(&(end..end)) && spans.iter().all(|span| span.start < end) {
            lines.pop();
        }
        // Position in the excerpt of each byte, and of the end.
        let (mut text, mut places) = (String::new(), Vec::with_capacity(end + 1));
        for (number, line) in lines.iter().enumerate() {
            let near = |other: usize| lines.get(other).is_some_and(|line| spans.iter().any(|span| meets(span, line)));
            // A label that ends between two lines ends with the first.
            places.resize(line.start, places.last().copied().unwrap_or_default());
            if near(number) || near(number + 1) || number.checked_sub(1).is_some_and(near) {
                let focus = spans.iter().map(|span| span.start).filter(|at| (line.start..=line.end).contains(at)).min();
                push_line(&mut text, &mut places, &data[line.clone()], focus.unwrap_or(line.start) - line.start);
            }
            text.push('\n');
        }
        places.resize(end + 1, places.last().copied().unwrap_or_default());
        let column = |label: &LabeledSpan| Some(source.read_span(&(label.offset(), 0).into(), 0, 0).ok()?.column());
        let columns = labels.iter().zip(&spans).filter_map(|(label, span)| Some((places[span.start], column(label)?)));
        let moved = labels.iter().zip(&spans).map(|(label, span)| {
            let text = label.label().map(|text| visible_line(text).into_owned());
            LabeledSpan::new(text, places[span.start], places[span.end] - places[span.start])
        });
        let (columns, moved) = (columns.collect(), moved.collect());
        let piece = SourceText::new(visible_line(whole.name().unwrap_or_default()), text);
        Some((Self { piece, first_line: whole.line(), columns }, moved))
    }
}

impl SourceCode for Excerpt {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let piece = self.piece.read_span(span, before, after)?;
        let known = self.columns.iter().find(|(place, _)| before == 0 && *place == span.offset());
        let column = known.map_or(piece.column(), |(_, column)| *column);
        let (data, at, line, count) = (piece.data(), *piece.span(), piece.line(), piece.line_count());
        let line = self.first_line + line;
        let name = self.piece.name().to_owned();
        Ok(Box::new(MietteSpanContents::new_named(name, data, at, line, column, count)))
    }
}

/// Formats a line for quotation in a table: trimmed, tabs replaced by blanks, and truncated around the byte `focus` if
/// it is long.
pub fn quoted_line(line: &str, focus: usize) -> String {
    let mut text = String::new();
    push_line(&mut text, &mut Vec::new(), line, focus);
    text.replace('\t', " ").trim().to_owned()
}

/// Returns the byte ranges of the lines of a text, without line ends. A label may be after the last line end.
fn line_ranges(text: &str) -> Vec<Range<usize>> {
    let bare = |line: &str| line.strip_suffix('\r').unwrap_or(line).len();
    let mut start = 0;
    let range = |line: &str| {
        let from = start;
        start += line.len() + 1;
        from..from + bare(line)
    };
    text.split('\n').map(range).collect()
}

/// Returns `true` if a span overlaps a line; the end of a line belongs to it.
fn meets(span: &Range<usize>, line: &Range<usize>) -> bool {
    span.start <= line.end && (line.start < span.end || line.start <= span.start)
}

/// Clips a span of too many lines to its first line.
fn clip(span: Range<usize>, lines: &[Range<usize>]) -> Range<usize> {
    let first = lines.partition_point(|line| line.end < span.start);
    let last = lines.partition_point(|line| line.start < span.end);
    match lines.get(first) {
        Some(line) if last.saturating_sub(first) > LINES => span.start..line.end.max(span.start),
        _ => span,
    }
}

/// Writes a line in displayed form, truncated around the byte `focus` if it is long. `places` gets the position in
/// `text` of each byte of the line, and of its end.
fn push_line(text: &mut String, places: &mut Vec<usize>, line: &str, focus: usize) {
    let (before, window) = (places.len(), window(line, focus));
    if window.start > 0 {
        text.push_str(CUT);
    }
    places.resize(before + window.start, text.len());
    for c in line[window.clone()].chars() {
        places.resize(places.len() + c.len_utf8(), text.len());
        if is_escaped(c) { text.extend(c.escape_default()) } else { text.push(c) }
    }
    places.resize(before + line.len() + 1, text.len());
    if window.end < line.len() {
        text.push_str(CUT);
    }
}

/// Range of a line's bytes that is shown: all of a short line, otherwise the bytes around `focus`.
fn window(line: &str, focus: usize) -> Range<usize> {
    if line.len() <= 4 * WIDTH && line.chars().map(width).sum::<usize>() <= WIDTH {
        return 0..line.len();
    }
    let focus = line.floor_char_boundary(focus);
    let start = line[..focus].char_indices().rev().take(BEFORE).last().map_or(focus, |(at, _)| at);
    let mut room = WIDTH;
    let beyond = line[start..].char_indices().find(|(_, c)| match room.checked_sub(width(*c)) {
        Some(rest) => {
            room = rest;
            false
        }
        None => true,
    });
    start..beyond.map_or(line.len(), |(at, _)| start + at)
}

/// Hidden characters are escaped, except for tabs.
const fn is_escaped(c: char) -> bool {
    is_hidden(c) && c != '\t'
}

/// Width in terminal columns. Zero-width characters count as one, which bounds the length of a line.
fn width(c: char) -> usize {
    match c {
        // Renderers write a tab as at most four blanks.
        '\t' => 4,
        c if is_hidden(c) => c.escape_default().len(),
        c => c.width().unwrap_or(1).max(1),
    }
}
