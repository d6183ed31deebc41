//! `NAME=VALUE` on the command line.

/// The two sides of the first `=`.
pub(super) fn parse(text: &str) -> Result<(String, String), String> {
    text.split_once('=')
        .filter(|(name, value)| !name.is_empty() && !value.is_empty())
        .map(|(name, value)| (name.to_owned(), value.to_owned()))
        .ok_or_else(|| format!("expected a switch as `rounding=rtz`, found `{text}`"))
}
