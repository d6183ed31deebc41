//! Trees of FPCore: atoms and lists, each with its span.

use std::ops::Range;
use std::sync::Arc;

use super::ExpressionError;
use crate::report::SourceText;

/// Deepest nesting; deeper trees would exhaust the stack.
pub(super) const MAX_DEPTH: usize = 200;

/// An atom or a list.
#[derive(Clone, Debug)]
pub(super) enum Tree {
    /// A name or a number; strings keep their first quote.
    Atom(String, Range<usize>),
    List(Vec<Tree>, Range<usize>),
}

impl Tree {
    pub(super) fn place(&self) -> Range<usize> {
        match self {
            Self::Atom(_, place) | Self::List(_, place) => place.clone(),
        }
    }

    pub(super) fn atom(&self) -> Option<&str> {
        if let Self::Atom(text, _) = self { Some(text) } else { None }
    }

    pub(super) fn list(&self) -> Option<&[Tree]> {
        if let Self::List(items, _) = self { Some(items) } else { None }
    }

    /// The first atom of a list.
    pub(super) fn head(&self) -> Option<&str> {
        self.list()?.first()?.atom()
    }
}

/// Parses all trees of a text.
///
/// # Errors
/// At an unmatched bracket, an unterminated string, or nesting beyond [`MAX_DEPTH`].
pub(super) fn parse(source: &Arc<SourceText>) -> Result<Vec<Tree>, ExpressionError> {
    let (text, mut at) = (source.text(), 0);
    let fail = |message: String, place| Err(ExpressionError::new(source, message, place));
    let mut open: Vec<(char, usize, Vec<Tree>)> = Vec::new();
    let mut done = Vec::new();
    while let Some(next) = text[at..].chars().next() {
        let from = at;
        at += next.len_utf8();
        let tree = match next {
            ';' => {
                at = text[at..].find('\n').map_or(text.len(), |end| at + end);
                continue;
            }
            _ if next.is_whitespace() => continue,
            '(' | '[' if open.len() == MAX_DEPTH => {
                return fail(format!("expected at most {MAX_DEPTH} nested lists"), from..at);
            }
            '(' | '[' => {
                open.push((if next == '(' { ')' } else { ']' }, from, Vec::new()));
                continue;
            }
            ')' | ']' => match open.pop() {
                Some((close, start, items)) if close == next => Tree::List(items, start..at),
                Some((close, ..)) => return fail(format!("expected `{close}`, found `{next}`"), from..at),
                None => return fail(format!("`{next}` closes nothing"), from..at),
            },
            '"' => {
                let mut escaped = false;
                let end = text[at..].char_indices().find(|(_, c)| {
                    let ends = *c == '"' && !escaped;
                    escaped = *c == '\\' && !escaped;
                    ends
                });
                let Some((end, _)) = end else {
                    return fail("expected a `\"` at the end of the text".to_owned(), from..at);
                };
                at += end + 1;
                Tree::Atom(text[from..at - 1].to_owned(), from..at)
            }
            _ => {
                let is_end = |c: char| c.is_whitespace() || "()[];\"".contains(c);
                at = text[from..].find(is_end).map_or(text.len(), |end| from + end);
                Tree::Atom(text[from..at].to_owned(), from..at)
            }
        };
        open.last_mut().map_or(&mut done, |(.., items)| items).push(tree);
    }
    match open.pop() {
        Some((close, start, _)) => fail(format!("expected a `{close}` for this bracket"), start..start + 1),
        None => Ok(done),
    }
}
