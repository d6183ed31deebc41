//! Expressions of printed values: numbers, names of figures, `+ - * /` with spaces on both sides, and parentheses.

use std::iter::Peekable;

/// Returns the value of an expression; `figure` returns the values of figures by name. Operators of equal precedence
/// apply from left to right, each with its result rounded to f64. Fails with a sentence if the text is not an
/// expression, and as `figure` does.
pub(super) fn evaluate(text: &str, figure: &dyn Fn(&str) -> Result<f64, String>) -> Result<f64, String> {
    // Names may contain hyphens, so an operator must be a word of its own.
    let spaced = text.replace('(', " ( ").replace(')', " ) ");
    let mut words = spaced.split_whitespace().peekable();
    let value = sum(&mut words, figure)?;
    words.next().map_or(Ok(value), |word| Err(format!("expected an operator in `{text}`, found `{word}`")))
}

fn sum<'a>(
    words: &mut Peekable<impl Iterator<Item = &'a str>>,
    figure: &dyn Fn(&str) -> Result<f64, String>,
) -> Result<f64, String> {
    let mut value = product(words, figure)?;
    while let Some(operator) = words.next_if(|word| matches!(*word, "+" | "-")) {
        let term = product(words, figure)?;
        value = if operator == "+" { value + term } else { value - term };
    }
    Ok(value)
}

fn product<'a>(
    words: &mut Peekable<impl Iterator<Item = &'a str>>,
    figure: &dyn Fn(&str) -> Result<f64, String>,
) -> Result<f64, String> {
    let mut value = factor(words, figure)?;
    while let Some(operator) = words.next_if(|word| matches!(*word, "*" | "/")) {
        let factor = factor(words, figure)?;
        value = if operator == "*" { value * factor } else { value / factor };
    }
    Ok(value)
}

fn factor<'a>(
    words: &mut Peekable<impl Iterator<Item = &'a str>>,
    figure: &dyn Fn(&str) -> Result<f64, String>,
) -> Result<f64, String> {
    match words.next() {
        None => Err("expected a number at the end of an expression".to_owned()),
        Some("(") => {
            let value = sum(words, figure)?;
            words.next_if_eq(&")").map(|_| value).ok_or_else(|| "expected `)`".to_owned())
        }
        Some(word) if word.starts_with(|first: char| first.is_ascii_digit()) => {
            word.parse().map_err(|_| format!("expected a number, found `{word}`"))
        }
        Some(name) => figure(name),
    }
}
