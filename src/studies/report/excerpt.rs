//! Excerpts of a text for error messages: lines around labels. Long lines are truncated, hidden characters escaped.

use std::ops::Range;
use std::slice;

use miette::{LabeledSpan, MietteError, MietteSpanContents, SourceCode, SourceSpan, SpanContents};

use unicode_width::UnicodeWidthChar as _;

use super::SourceText;
use super::visible::{is_hidden, visible_line};

/// Maximum columns of a line, including escapes but not the marks of truncation.
const WIDTH: usize = 80;
/// Minimum number of characters before a label in a truncated line.
const BEFORE: usize = 20;
/// Mark of truncation.
const CUT: &str = "...";
/// Maximum number of lines shown of a label; a longer label shows only its first line.
const LINES: usize = 8;

/// Excerpt of a text in the form that a renderer of diagnostics needs, with its position in the text.
#[derive(Clone, Debug)]
pub struct Excerpt {
    piece: SourceText,
    named: bool,
    /// Number of lines before the excerpt.
    first_line: usize,
    /// Per label: its position in the excerpt, and its column in the whole text, from 0, in characters.
    columns: Vec<(usize, usize)>,
}

impl Excerpt {
    /// Extracts the lines of `source` around `labels`; also returns the labels' positions in the excerpt. `None` if
    /// there are no labels, or a label lies outside the text.
    pub fn new(source: &dyn SourceCode, labels: &[LabeledSpan]) -> Option<(Self, Vec<LabeledSpan>)> {
        let low = labels.iter().map(LabeledSpan::offset).min()?;
        let high = labels.iter().map(|label| label.offset().saturating_add(label.len())).max()?;
        let whole = source.read_span(&(low, high - low).into(), 1, 1).ok()?;
        let base = whole.span().offset();
        let mut lines: Vec<Range<usize>> = line_ranges(whole.data());
        let spans: Vec<Range<usize>> = labels
            .iter()
            .map(|label| {
                let start = label.offset() - base;
                clip(start..start + label.len(), &lines)
            })
            .collect();
        // The empty line after the last line end is shown only if a label is on it.
        let end = whole.data().len();
        if lines.len() > 1 && lines.last() == Some(&(end..end)) && spans.iter().all(|span| span.start < end) {
            lines.pop();
        }
        let mut text = String::new();
        let mut placed = vec![0..0; labels.len()];
        for (number, line) in lines.iter().enumerate() {
            let near = |other: usize| lines.get(other).is_some_and(|line| spans.iter().any(|span| meets(span, line)));
            if near(number) || near(number + 1) || number.checked_sub(1).is_some_and(near) {
                push_line(&mut text, &whole.data()[line.clone()], line.start, &spans, &mut placed);
            }
            text.push('\n');
        }
        let column = |label: &LabeledSpan| Some(source.read_span(&(label.offset(), 0).into(), 0, 0).ok()?.column());
        let columns =
            labels.iter().zip(&placed).filter_map(|(label, place)| Some((place.start, column(label)?))).collect();
        let name = visible_line(whole.name().unwrap_or_default());
        let moved = labels.iter().zip(placed).map(|(label, place)| {
            let text = label.label().map(|text| visible_line(text).into_owned());
            LabeledSpan::new(text, place.start, place.end - place.start)
        });
        let moved = moved.collect();
        let (piece, named) = (SourceText::new(name, text), whole.name().is_some());
        Some((Self { piece, named, first_line: whole.line(), columns }, moved))
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
        Ok(Box::new(match self.named {
            true => MietteSpanContents::new_named(self.piece.name().to_owned(), data, at, line, column, count),
            false => MietteSpanContents::new(data, at, line, column, count),
        }))
    }
}

/// Formats a line for quotation in a table: trimmed, tabs replaced by blanks, and truncated around the byte `focus` if
/// it is long.
pub fn quoted_line(line: &str, focus: usize) -> String {
    let mut text = String::new();
    push_line(&mut text, line.as_bytes(), 0, slice::from_ref(&(focus..focus)), slice::from_mut(&mut (0..0)));
    text.replace('\t', " ").trim().to_owned()
}

/// Returns the byte ranges of the lines of a text, without line ends.
fn line_ranges(text: &[u8]) -> Vec<Range<usize>> {
    let mut lines = Vec::new();
    let mut start = 0;
    for line in text.split_inclusive(|&b| b == b'\n') {
        let bare = line.strip_suffix(b"\n").unwrap_or(line);
        let bare = bare.strip_suffix(b"\r").unwrap_or(bare);
        lines.push(start..start + bare.len());
        start += line.len();
    }
    // A label may be after the last line end.
    if text.last().is_none_or(|&b| b == b'\n') {
        lines.push(start..start);
    }
    lines
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

/// Writes a line in displayed form, and records the positions in `text` of the spans that start or end on it.
fn push_line(text: &mut String, line: &[u8], start: usize, spans: &[Range<usize>], placed: &mut [Range<usize>]) {
    let begins: Vec<usize> =
        spans.iter().filter(|s| (start..=start + line.len()).contains(&s.start)).map(|s| s.start - start).collect();
    let window = window(line, begins.iter().min().copied());
    if window.start > 0 {
        text.push_str(CUT);
    }
    // Output position of each byte of the line's window.
    let mut places = vec![text.len(); window.len() + 1];
    let mut at = window.start;
    for piece in characters(&line[window.clone()]) {
        let place = text.len();
        push_visible(text, &piece);
        places[at - window.start..at - window.start + piece.bytes()].fill(place);
        at += piece.bytes();
        places[at - window.start] = text.len();
    }
    let place = |byte: usize| places[byte.clamp(window.start, window.end) - window.start];
    for (span, placed) in spans.iter().zip(placed) {
        let on_line = |byte: usize| (start..=start + line.len()).contains(&byte);
        if on_line(span.start) {
            *placed = place(span.start - start)..placed.end;
            // A span that ends in a truncated part or on another line must not end before its start.
            placed.end = placed.start;
        }
        if on_line(span.end) && span.end >= span.start {
            placed.end = place(span.end - start).max(placed.start);
        } else if span.start <= start + line.len() && span.end > start + line.len() {
            placed.end = text.len().max(placed.start);
        }
    }
    if window.end < line.len() {
        text.push_str(CUT);
    }
}

/// Range of a line's bytes that is shown: all of a short line, otherwise the bytes around `focus`.
fn window(line: &[u8], focus: Option<usize>) -> Range<usize> {
    let fits = line.len() <= 4 * WIDTH && width(line) <= WIDTH;
    if fits {
        return 0..line.len();
    }
    let mut start = focus.unwrap_or(0).min(line.len());
    for _ in 0..BEFORE {
        start = previous(line, start);
    }
    let (mut end, mut room) = (start, WIDTH);
    // No character takes more than four bytes.
    for piece in characters(&line[start..line.len().min(start + 4 * WIDTH)]) {
        let Some(rest) = room.checked_sub(piece.width()) else { break };
        room = rest;
        end += piece.bytes();
    }
    start..end
}

/// Start of the character before `at`.
fn previous(line: &[u8], at: usize) -> usize {
    let mut start = at.saturating_sub(1);
    while start > 0 && at - start < 4 && line[start] & 0xc0 == 0x80 {
        start -= 1;
    }
    start
}

/// Character of a line, or a byte outside any UTF-8 character.
enum Piece {
    Character(char),
    Byte(u8),
}

impl Piece {
    const fn bytes(&self) -> usize {
        match self {
            Self::Character(c) => c.len_utf8(),
            Self::Byte(_) => 1,
        }
    }

    /// Width in terminal columns. Zero-width characters count as one, which bounds the length of a line.
    fn width(&self) -> usize {
        match self {
            // Renderers write a tab as at most four blanks.
            Self::Character('\t') => 4,
            Self::Character(c) if is_hidden(*c) => c.escape_default().len(),
            Self::Character(c) => c.width().unwrap_or(1).max(1),
            Self::Byte(_) => 4,
        }
    }
}

fn width(line: &[u8]) -> usize {
    characters(line).map(|piece| piece.width()).sum()
}

fn characters(line: &[u8]) -> impl Iterator<Item = Piece> {
    line.utf8_chunks().flat_map(|chunk| {
        chunk.valid().chars().map(Piece::Character).chain(chunk.invalid().iter().copied().map(Piece::Byte))
    })
}

fn push_visible(text: &mut String, piece: &Piece) {
    match piece {
        Piece::Character(c) if is_hidden(*c) && *c != '\t' => text.extend(c.escape_default()),
        Piece::Character(c) => text.push(*c),
        Piece::Byte(byte) => text.push_str(&format!("\\x{byte:02x}")),
    }
}
