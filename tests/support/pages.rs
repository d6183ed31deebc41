//! Files and blocks of pages that the program generates: compared, or written by `INSTA_UPDATE=always`.
#![allow(dead_code, reason = "shared by several test binaries, each of which takes what it needs")]

use std::fs;
use std::path::Path;

use crate::environment::writes_files;

/// Compares a file with its expected contents, or writes it.
pub(crate) fn hold(path: &Path, expected: &str) {
    hold_bytes(path, expected.as_bytes());
}

/// Compares a file of bytes with its expected contents, or writes it. Line ends of texts may differ by system.
pub(crate) fn hold_bytes(path: &Path, expected: &[u8]) {
    if writes_files() {
        fs::write(path, expected).expect("it can be written");
    }
    let found = fs::read(path).unwrap_or_default();
    let (same, other) = match (str::from_utf8(&found), str::from_utf8(expected)) {
        (Ok(found), Ok(expected)) => {
            let mut lines = expected.lines().zip(found.lines());
            (found.replace('\r', "") == expected, lines.find(|(expected, found)| expected != found))
        }
        _ => (found == expected, None),
    };
    let path = path.display();
    assert!(same, "{path} is out of date, INSTA_UPDATE=always cargo test writes it; expected, found: {other:?}");
}

/// The text with each block between `<!-- KIND: NAME -->` and `<!-- /KIND -->` replaced by `said(NAME)`.
pub(crate) fn filled(text: &str, kind: &str, said: impl Fn(&str) -> String) -> String {
    let (begin, end) = (format!("<!-- {kind}: "), format!("<!-- /{kind} -->"));
    let mut parts = text.split(&begin);
    let mut out = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (name, rest) = part.split_once(" -->").expect("the mark's end");
        let (_, rest) = rest.split_once(&end).expect("an end mark for each mark");
        out.push_str(&format!("{begin}{name} -->{}{end}{rest}", said(name)));
    }
    out
}

#[test]
fn blocks_are_filled() {
    let text = "a <!-- study: tally -->old<!-- /study --> b <!-- other: x -->old<!-- /other -->";
    assert_eq!(filled(text, "study", str::to_uppercase), text.replacen("old", "TALLY", 1));
}
