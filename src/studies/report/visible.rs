//! Escaping of external text for display: nothing in it moves a cursor, changes a color or reorders letters.
//!
//! Every renderer uses this: messages, tables, pages, and printed output. A message that arrives escaped stays
//! unchanged.

use std::borrow::Cow;
use std::fmt::Write as _;

/// Returns `true` for characters that affect the display instead of being visible: controls (C0, DEL, C1), Unicode's
/// formatting characters (general category Cf: bidirectional overrides, joiners, tags) and its line and paragraph
/// separators.
pub const fn is_hidden(c: char) -> bool {
    matches!(c,
        '\u{0}'..='\u{1f}' | '\u{7f}'..='\u{9f}' | '\u{ad}'
        | '\u{600}'..='\u{605}' | '\u{61c}' | '\u{6dd}' | '\u{70f}' | '\u{890}'..='\u{891}' | '\u{8e2}'
        | '\u{180e}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}'
        | '\u{feff}' | '\u{fff9}'..='\u{fffb}'
        | '\u{110bd}' | '\u{110cd}' | '\u{13430}'..='\u{1343f}' | '\u{1bca0}'..='\u{1bca3}'
        | '\u{1d173}'..='\u{1d17a}' | '\u{e0000}'..='\u{e007f}'
    )
}

/// Escapes text of several lines: line ends stay, all other [`is_hidden`] characters become escapes such as `\u{1b}`.
pub fn visible(text: &str) -> Cow<'_, str> {
    escaped(text, |c| c != '\n' && is_hidden(c), |shown, c| shown.extend(c.escape_default()))
}

/// Escapes text for a single line: line ends are escaped too.
pub fn visible_line(text: &str) -> Cow<'_, str> {
    escaped(text, is_hidden, |shown, c| shown.extend(c.escape_default()))
}

/// Escapes the hidden characters of a JSON document with JSON's own escapes, such as `\u001b`. Readers get the same
/// text: in a finished document, hidden characters other than line ends occur only inside strings.
pub fn visible_json(document: &str) -> Cow<'_, str> {
    escaped(
        document,
        |c| c != '\n' && is_hidden(c),
        |shown, c| {
            for unit in c.encode_utf16(&mut [0; 2]) {
                // Writing to a string cannot fail.
                write!(shown, "\\u{unit:04x}").ok();
            }
        },
    )
}

fn escaped(text: &str, hidden: impl Fn(char) -> bool + Copy, escape: impl Fn(&mut String, char)) -> Cow<'_, str> {
    if !text.contains(hidden) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len() + 16);
    for c in text.chars() {
        if hidden(c) { escape(&mut shown, c) } else { shown.push(c) }
    }
    Cow::Owned(shown)
}
