//! Lines, words and numbers of text formats.

use super::{NumberError, parse_f32, parse_f64};

/// Lines with their numbers, without comments; a line that ends in `\` goes on in the next.
pub(super) fn logical_lines(bytes: &[u8]) -> impl Iterator<Item = (usize, Vec<u8>)> + '_ {
    // Some editors mark UTF-8 with three bytes; left there, they would hide the first vertex.
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut lines = (1..).zip(bytes.split(|&byte| byte == b'\n'));
    std::iter::from_fn(move || {
        let (number, first) = lines.next()?;
        let mut text = strip(first).to_vec();
        while text.last() == Some(&b'\\') {
            text.pop();
            text.push(b' ');
            let Some((_, next)) = lines.next() else { break };
            text.extend_from_slice(strip(next));
        }
        Some((number, text))
    })
}

/// A line without its comment and the white space around it.
fn strip(line: &[u8]) -> &[u8] {
    let end = line.iter().position(|&byte| byte == b'#').unwrap_or(line.len());
    line[..end].trim_ascii()
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
