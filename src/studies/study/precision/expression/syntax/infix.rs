//! Formulas in infix notation, as trees of FPCore.
//!
//! Operators by increasing precedence: `a ? b : c`, `||`, `&&`, comparisons, sums, products, signs, powers (`^`,
//! right-associative).

use std::ops::Range;
use std::sync::Arc;

use super::ExpressionError;
use super::text::{MAX_DEPTH, Tree};
use crate::report::SourceText;

/// Binary operators with their precedence, and the names of their operations.
const OPERATORS: [(&str, u8, &str); 13] = [
    ("||", 1, "or"),
    ("&&", 2, "and"),
    ("<=", 3, "<="),
    (">=", 3, ">="),
    ("==", 3, "=="),
    ("!=", 3, "!="),
    ("<", 3, "<"),
    (">", 3, ">"),
    ("+", 4, "+"),
    ("-", 4, "-"),
    ("*", 5, "*"),
    ("/", 5, "/"),
    ("^", 7, "pow"),
];
const SIGN: u8 = 6;

/// Most operators in a formula.
const MAX_OPERATORS: usize = 2000;

/// Names that shading languages have for functions and constants of FPCore.
const NAMES: [(&str, &str); 8] = [
    ("abs", "fabs"),
    ("min", "fmin"),
    ("max", "fmax"),
    ("ln", "log"),
    ("pi", "PI"),
    ("π", "PI"),
    ("true", "TRUE"),
    ("false", "FALSE"),
];

/// Parses a formula.
///
/// # Errors
/// At the first unexpected token.
pub(super) fn parse(source: &Arc<SourceText>) -> Result<Tree, ExpressionError> {
    let mut parser = Parser { source, at: 0, depth: 0, operators: 0 };
    let tree = parser.choice()?;
    if parser.at < source.text().len() {
        return Err(parser.expected("an operator"));
    }
    Ok(tree)
}

struct Parser<'a> {
    source: &'a Arc<SourceText>,
    at: usize,
    depth: usize,
    operators: usize,
}

impl Parser<'_> {
    fn rest(&self) -> &str {
        &self.source.text()[self.at..]
    }

    fn skip_blanks(&mut self) {
        self.at += self.rest().len() - self.rest().trim_start().len();
    }

    fn take(&mut self, token: &str) -> bool {
        self.skip_blanks();
        let is_there = self.rest().starts_with(token);
        self.at += if is_there { token.len() } else { 0 };
        is_there
    }

    fn expected(&self, what: &str) -> ExpressionError {
        let found = self.rest().chars().next();
        let length = found.map_or(0, char::len_utf8);
        let found = found.map_or("the end".to_owned(), |c| format!("`{c}`"));
        ExpressionError::new(self.source, format!("expected {what}, found {found}"), self.at..self.at + length)
    }

    fn list(name: &str, operands: Vec<Tree>, place: Range<usize>) -> Tree {
        let name = Tree::Atom(name.to_owned(), place.clone());
        Tree::List(std::iter::once(name).chain(operands).collect(), place)
    }

    /// Enters one level of nesting.
    fn enter(&mut self) -> Result<(), ExpressionError> {
        self.skip_blanks();
        self.depth += 1;
        if self.depth > MAX_DEPTH { Err(self.expected(&format!("at most {MAX_DEPTH} nested parts"))) } else { Ok(()) }
    }

    fn choice(&mut self) -> Result<Tree, ExpressionError> {
        self.enter()?;
        let from = self.at;
        let mut tree = self.operation(1)?;
        if self.take("?") {
            let yes = self.choice()?;
            if !self.take(":") {
                return Err(self.expected("`:`"));
            }
            let no = self.choice()?;
            tree = Self::list("if", vec![tree, yes, no], from..self.at);
        }
        self.skip_blanks();
        self.depth -= 1;
        Ok(tree)
    }

    /// Operands joined by operators of at least this precedence.
    fn operation(&mut self, least: u8) -> Result<Tree, ExpressionError> {
        self.enter()?;
        let from = self.at;
        let mut left = if self.take("-") {
            let operand = self.operation(SIGN)?;
            Self::list("-", vec![operand], from..self.at)
        } else if !self.rest().starts_with("!=") && self.take("!") {
            let operand = self.operation(SIGN)?;
            Self::list("not", vec![operand], from..self.at)
        } else {
            self.operand()?
        };
        loop {
            self.skip_blanks();
            let next = OPERATORS.iter().find(|(sign, tight, _)| *tight >= least && self.rest().starts_with(sign));
            let Some((sign, tight, name)) = next else { break };
            self.operators += 1;
            if self.operators > MAX_OPERATORS {
                return Err(self.expected(&format!("at most {MAX_OPERATORS} operators")));
            }
            self.at += sign.len();
            // Powers are right-associative.
            let right = self.operation(if *name == "pow" { SIGN } else { tight + 1 })?;
            // The span of an operation includes the parentheses around its operands.
            let end = self.source.text()[..self.at].trim_end().len();
            left = Self::list(name, vec![left, right], from..end);
        }
        self.depth -= 1;
        Ok(left)
    }

    /// A number, a variable, a call, or a formula in parentheses.
    fn operand(&mut self) -> Result<Tree, ExpressionError> {
        let from = self.at;
        if self.take("(") {
            let inner = self.choice()?;
            return if self.take(")") { Ok(inner) } else { Err(self.expected("`)`")) };
        }
        let length = self.word_length();
        if length == 0 {
            return Err(self.expected("a number, a name or `(`"));
        }
        self.at += length;
        let word = self.source.text()[from..self.at].to_owned();
        let name = NAMES.iter().find(|(ours, _)| *ours == word).map_or(word.as_str(), |(_, name)| name).to_owned();
        if !self.take("(") {
            return Ok(Tree::Atom(name, from..from + length));
        }
        let mut operands = Vec::new();
        loop {
            operands.push(self.choice()?);
            if self.take(")") {
                return Ok(Self::list(&name, operands, from..self.at));
            }
            if !self.take(",") {
                return Err(self.expected("`,` or `)`"));
            }
        }
    }

    /// Length in bytes of the name or number at the current position; the sign of an exponent belongs to its number.
    fn word_length(&self) -> usize {
        let is_number = self.rest().starts_with(|c: char| c.is_ascii_digit() || c == '.');
        let is_hexadecimal = self.rest().starts_with("0x");
        let mut before = ' ';
        let end = self.rest().find(|c: char| {
            let exponent = if is_hexadecimal { "pP" } else { "eE" };
            let is_sign = is_number && exponent.contains(before) && "+-".contains(c);
            before = c;
            !(c.is_alphanumeric() || c == '_' || c == '.' || is_sign)
        });
        end.unwrap_or(self.rest().len())
    }
}
