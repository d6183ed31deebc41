//! Sanitising of external text for display: nothing in it moves a cursor, changes a color or reorders letters.
//!
//! Every renderer goes through here: messages, tables, pages, and what commands print. A message that arrives escaped
//! stays as it is.

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

/// Escapes text of several lines: line ends are kept, all other [`is_hidden`] characters are escaped as in `\u{1b}`.
pub fn visible(text: &str) -> Cow<'_, str> {
    escaped(text, |c| c != '\n' && is_hidden(c))
}

/// Escapes text for a single line: line ends are escaped too.
pub fn visible_line(text: &str) -> Cow<'_, str> {
    escaped(text, is_hidden)
}

/// Escapes the hidden characters of a JSON document by JSON's own escapes, `\u001b`. Readers get the same text: a
/// finished document has hidden characters, apart from the line ends between its parts, only inside strings.
pub fn visible_json(document: &str) -> Cow<'_, str> {
    let hidden = |c: char| c != '\n' && is_hidden(c);
    if !document.contains(hidden) {
        return Cow::Borrowed(document);
    }
    let mut shown = String::with_capacity(document.len() + 16);
    for c in document.chars() {
        if hidden(c) {
            for unit in c.encode_utf16(&mut [0; 2]) {
                // Writing to a string cannot fail.
                write!(shown, "\\u{unit:04x}").ok();
            }
        } else {
            shown.push(c);
        }
    }
    Cow::Owned(shown)
}

fn escaped(text: &str, hidden: impl Fn(char) -> bool + Copy) -> Cow<'_, str> {
    if !text.contains(hidden) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len() + 16);
    for c in text.chars() {
        if hidden(c) { shown.extend(c.escape_default()) } else { shown.push(c) }
    }
    Cow::Owned(shown)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_acts_is_escaped_and_what_is_seen_stays() {
        assert_eq!(visible("a\x1b[31mb\u{202e}c\nd\te"), "a\\u{1b}[31mb\\u{202e}c\nd\\te");
        assert_eq!(visible_line("a\nb\r"), "a\\nb\\r");
        for plain in ["Grüße, Größe", "\u{65e5}\u{672c}", "r0.xyz \\u{1b} 'x'", "e\u{301}", "\u{1f600}", ""] {
            assert!(matches!(visible_line(plain), Cow::Borrowed(same) if same == plain), "{plain:?}");
        }
    }

    #[test]
    fn every_control_character_is_hidden() {
        assert!(('\0'..=char::MAX).filter(|c| c.is_control()).all(is_hidden));
    }

    #[test]
    fn json_reads_back_to_the_same_text() {
        let said = "a\x1b\u{85}\u{202e}\u{e0041}\n\"\\";
        let document = serde_json::to_string_pretty(&[said]).expect("text");
        let shown = visible_json(&document);
        assert!(!shown.contains(|c| c != '\n' && is_hidden(c)), "{shown}");
        assert_eq!(serde_json::from_str::<Vec<String>>(&shown).expect("JSON"), [said]);
    }
}
