//! Changes the white space between the tokens of a program's text.

use refsim::asm::assemble;

/// Splits a line into words, numbers and punctuation marks.
fn pieces(line: &str) -> Vec<&str> {
    let mut pieces = Vec::new();
    let mut rest = line.trim_start();
    while !rest.is_empty() {
        let (piece, behind) = rest.split_at(length(rest.as_bytes()));
        pieces.push(piece);
        rest = behind.trim_start();
    }
    pieces
}

/// Length of the first token of an ASCII text.
fn length(text: &[u8]) -> usize {
    let at = |i: usize| text.get(i).copied().unwrap_or(0);
    let count = |from: usize, wanted: fn(u8) -> bool| (from..).take_while(|&i| wanted(at(i))).count();
    let word = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_' || byte == b'$';
    let digit = |byte: u8| byte.is_ascii_digit();
    match at(0) {
        b'.' if at(1) == b'.' => 2,
        first if digit(first) || (first == b'.' && digit(at(1))) => {
            let mut length = count(0, digit);
            if at(length) == b'.' && at(length + 1) != b'.' {
                length += 1 + count(length + 1, digit);
            }
            if matches!(at(length), b'e' | b'E') && matches!(at(length + 1), b'+' | b'-') {
                length += 2;
            }
            length + count(length, word)
        }
        first if word(first) => count(0, word),
        _ => 1,
    }
}

/// The grammar is unambiguous: changed white space yields the same program; a removed space yields it or an error. The
/// first line, which names the language, stays unchanged.
///
/// `gaps` are spaces and comments; `choose` selects one gap for each boundary of tokens, and one boundary without a
/// gap.
pub(crate) fn has_one_reading(text: &str, gaps: &[&str], mut choose: impl FnMut(usize) -> usize) {
    let expected = assemble(text).unwrap_or_else(|errors| panic!("{text}\n{errors:?}"));
    let (header, body) = text.split_once('\n').unwrap_or((text, ""));
    let lines: Vec<Vec<&str>> = body.lines().map(pieces).collect();
    let closed = choose(lines.iter().map(Vec::len).sum::<usize>().max(1));
    let [mut spread, mut glued] = [format!("{header}\n"), format!("{header}\n")];
    let mut number = 0;
    for line in &lines {
        for (place, piece) in line.iter().enumerate() {
            let gap = if place == 0 { "" } else { gaps[choose(gaps.len())] };
            spread += gap;
            glued += if number == closed { "" } else { gap };
            spread += piece;
            glued += piece;
            number += 1;
        }
        spread.push('\n');
        glued.push('\n');
    }
    assert_eq!(assemble(&spread).as_ref(), Ok(&expected), "{spread}");
    if let Ok(found) = assemble(&glued) {
        assert_eq!(found, expected, "{glued}");
    }
}
