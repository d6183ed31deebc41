//! Lines, words and numbers of text formats.

use std::path::Path;

use super::error::syntax_error;
use super::{NumberError, parse_f32, parse_f64};
use crate::error::InputError;

/// Text without the byte order mark that some editors write before UTF-8.
pub(super) fn unmarked(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}

/// Text of a file without a declared encoding: UTF-8, or else Latin-1, in which each byte is a character.
pub(super) fn decoded(text: &[u8]) -> String {
    std::str::from_utf8(text).map_or_else(|_| text.iter().copied().map(char::from).collect(), str::to_owned)
}

/// Rejects text in UTF-16, which some editors write.
pub(super) fn not_utf_16(bytes: &[u8], name: &Path) -> Result<(), InputError> {
    let zeros = |at: usize| bytes.get(at..at + 2).map(|pair| [pair[0] == 0, pair[1] == 0]);
    let unmarked = matches!(zeros(0), Some([low, high]) if low != high) && zeros(0) == zeros(2);
    if unmarked || bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        return Err(syntax_error(name, "text in UTF-8 or Latin-1", "UTF-16"));
    }
    Ok(())
}

/// Lines with their numbers; LF, CR LF and a lone CR all end a line.
pub(super) fn lines(bytes: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    fn by_cr(line: &[u8]) -> impl Iterator<Item = &[u8]> {
        line.strip_suffix(b"\r").unwrap_or(line).split(|&byte| byte == b'\r')
    }
    (1..).zip(bytes.split(|&byte| byte == b'\n').flat_map(by_cr))
}

/// Lines with their numbers, without white space around them; a line that ends in `\` outside of a comment continues in
/// the next.
pub(super) fn logical_lines(bytes: &[u8]) -> impl Iterator<Item = (usize, Vec<u8>)> + '_ {
    let mut lines = lines(unmarked(bytes));
    std::iter::from_fn(move || {
        let (number, first) = lines.next()?;
        let mut text = first.trim_ascii().to_vec();
        while text.last() == Some(&b'\\') && before_comment(&text).len() == text.len() {
            text.pop();
            text.push(b' ');
            let Some((_, next)) = lines.next() else { break };
            text.extend_from_slice(next.trim_ascii());
        }
        Some((number, text))
    })
}

/// The part of a line before its comment, which begins at a word that begins with `#`.
pub(super) fn before_comment(text: &[u8]) -> &[u8] {
    let begins = |at: &usize| text[*at] == b'#' && (*at == 0 || text[at - 1].is_ascii_whitespace());
    &text[..(0..text.len()).find(begins).unwrap_or(text.len())]
}

/// The words of a line before its comment.
pub(super) fn statement(text: &[u8]) -> Vec<&[u8]> {
    words(before_comment(text))
}

/// The words of a line.
pub(super) fn words(text: &[u8]) -> Vec<&[u8]> {
    text.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty()).collect()
}

/// A number of single precision in a line of a file.
pub(super) fn single(word: &[u8]) -> Result<f32, NumberError> {
    std::str::from_utf8(word).map_err(|_| NumberError::NoNumber).and_then(parse_f32)
}

/// As `single`, in double precision.
pub(super) fn double(word: &[u8]) -> Result<f64, NumberError> {
    std::str::from_utf8(word).map_err(|_| NumberError::NoNumber).and_then(parse_f64)
}
