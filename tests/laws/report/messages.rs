//! Error messages that quote a text: no hidden characters, bounded length, the right column, and never a panic.

use std::fmt;
use std::ops::Range;

use crossbar::report::visible::is_hidden;
use crossbar::report::{Excerpt, SourceText};
use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, SourceCode};
use proptest::prelude::*;

/// A message with an excerpt and labels.
#[derive(Debug)]
struct Message(Excerpt, Vec<LabeledSpan>);

impl fmt::Display for Message {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("wrong")
    }
}
impl std::error::Error for Message {}
impl Diagnostic for Message {
    fn source_code(&self) -> Option<&dyn SourceCode> {
        Some(&self.0)
    }
    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        Some(Box::new(self.1.iter().cloned()))
    }
}

fn rendered(source: &dyn SourceCode, spans: &[Range<usize>]) -> String {
    let labels: Vec<_> = spans.iter().map(|s| LabeledSpan::new(Some("here".to_owned()), s.start, s.len())).collect();
    let (excerpt, labels) = Excerpt::new(source, &labels).expect("labels within the text");
    let mut text = String::new();
    let handler = GraphicalReportHandler::new_themed(GraphicalTheme::none()).with_width(100);
    handler.render_report(&mut text, &Message(excerpt, labels)).expect("a message");
    // At most 80 characters of the text and two truncation marks, after line numbers of at most 8 digits.
    assert!(text.lines().all(|line| line.chars().count() <= 80 + 6 + 8 + 10), "{text}");
    text
}

fn rendered_at(source: &dyn SourceCode, span: Range<usize>) -> String {
    rendered(source, std::slice::from_ref(&span))
}

#[test]
fn a_short_line_stays_whole() {
    let source = SourceText::new("x.psa", "ps_1_4\nmov r0, \x1b[31mc0\nend\n");
    let text = rendered_at(&source, 16..18);
    assert!(text.contains("[x.psa:2:10]") && text.contains("| mov r0, \\u{1b}[31mc0\n"), "{text}");
}

#[test]
fn a_long_line_is_cut_around_its_label() {
    let line = format!("{}mov r0, wrong{}", "é".repeat(70_000), " ; more".repeat(100_000));
    let at = line.find("wrong").expect("there");
    let source = SourceText::new("x.psa", format!("ps_1_4\n{line}\n{line}"));
    let text = rendered_at(&source, 7 + at..7 + at + 5);
    assert!(text.contains("[x.psa:2:70009]"), "{text}");
    assert!(text.contains("| ...éééééééééééémov r0, wrong ; more") && text.len() < 1000, "{text}");
}

#[test]
fn labels_at_the_edges_of_a_text() {
    for text in ["", "\n", "a", "a\n", "a\r\nb", "\u{feff}"] {
        let source = SourceText::new("x", text);
        for start in (0..=text.len()).filter(|&at| text.is_char_boundary(at)) {
            rendered_at(&source, start..start);
            rendered_at(&source, start..text.len());
        }
    }
}

/// Bytes with many line ends, tabs, control characters, invalid UTF-8, and overlong lines.
fn bytes() -> impl Strategy<Value = Vec<u8>> {
    let piece = prop_oneof![
        4 => prop::collection::vec(any::<u8>(), 0..30),
        3 => "[a-z0-9 ,._\t\n]{0,40}".prop_map(String::into_bytes),
        2 => "\\PC{0,30}".prop_map(String::into_bytes),
        1 => (any::<char>(), 0..400_usize).prop_map(|(c, n)| c.to_string().repeat(n).into_bytes()),
    ];
    prop::collection::vec(piece, 0..12).prop_map(|pieces| pieces.concat())
}

proptest! {
    #[test]
    fn nothing_hidden_comes_through(bytes in bytes(), places in prop::collection::vec(any::<[prop::sample::Index; 2]>(), 1..4)) {
        let spans: Vec<_> = places.iter().map(|[a, b]| {
            let [a, b] = [a, b].map(|i| i.index(bytes.len() + 1));
            a.min(b)..a.max(b)
        }).collect();
        let lossy = String::from_utf8_lossy(&bytes).into_owned();
        let inside: Vec<_> = spans.iter().map(|s| {
            let [start, end] = [s.start, s.end].map(|at| lossy.floor_char_boundary(at));
            start..end
        }).collect();
        let text = rendered(&SourceText::new("\x1b[1mx", lossy), &inside);
        prop_assert!(!text.contains(|c| c != '\n' && is_hidden(c)), "{text:?}");
    }

    #[test]
    fn columns_count_characters(line in "\\PC{0,300}", place in any::<prop::sample::Index>()) {
        let ends: Vec<usize> = line.char_indices().map(|(at, _)| at).chain([line.len()]).collect();
        let column = place.index(ends.len());
        let at = 6 + ends[column];
        let text = rendered_at(&SourceText::new("x", format!("first\n{line}\n")), at..at);
        prop_assert!(text.contains(&format!("[x:2:{}]", column + 1)), "{text}");
    }
}
