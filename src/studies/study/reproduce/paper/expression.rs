//! Expressions of printed values: numbers, names of figures, `+ - * /` with spaces on both sides, and parentheses.

use std::iter::Peekable;

/// Returns the value of an expression; `figure` returns the values of figures by name. Operators of equal precedence
/// apply from left to right, each with its result rounded to f64. Fails with a sentence if the text is not an
/// expression, and as `figure` does.
pub(super) fn evaluate(text: &str, figure: &dyn Fn(&str) -> Result<f64, String>) -> Result<f64, String> {
    // Names may contain hyphens, so an operator must be a word of its own.
    let spaced = text.replace('(', " ( ").replace(')', " ) ");
    let mut words = spaced.split_whitespace().peekable();
    let value = terms(&mut words, figure, 0)?;
    words.next().map_or(Ok(value), |word| Err(format!("expected an operator in `{text}`, found `{word}`")))
}

/// Precedence of an operator; `None` for another word.
fn precedence(word: &str) -> Option<usize> {
    ["+-", "*/"].iter().position(|operators| word.len() == 1 && operators.contains(word))
}

/// Value of operands that are joined by operators of at least this precedence.
fn terms<'a>(
    words: &mut Peekable<impl Iterator<Item = &'a str>>,
    figure: &dyn Fn(&str) -> Result<f64, String>,
    least: usize,
) -> Result<f64, String> {
    let mut value = match words.next() {
        None => return Err("expected a number at the end of an expression".to_owned()),
        Some("(") => {
            let value = terms(words, figure, 0)?;
            words.next_if_eq(&")").map(|_| value).ok_or_else(|| "expected `)`".to_owned())?
        }
        Some(word) if word.starts_with(|first: char| first.is_ascii_digit()) => {
            word.parse().map_err(|_| format!("expected a number, found `{word}`"))?
        }
        Some(name) => figure(name)?,
    };
    while let Some(operator) = words.next_if(|word| precedence(word).is_some_and(|rank| rank >= least)) {
        let right = terms(words, figure, precedence(operator).map_or(0, |rank| rank + 1))?;
        value = match operator {
            "+" => value + right,
            "-" => value - right,
            "*" => value * right,
            _ => value / right,
        };
    }
    Ok(value)
}
