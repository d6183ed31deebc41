//! Entries of tables.

use serde_json::Value;

use super::digits::{self, Quantity};
use super::fold::Folded;

/// One entry of a table.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// Words.
    Text(String),
    /// A number of things.
    Count(u64),
    /// A whole number with a sign.
    Int(i64),
    /// A measured or computed number.
    Real(Figure),
    /// Yes or no.
    Flag(bool),
    /// Rows that are left out because they found the same as one above.
    Folded(Folded),
    /// Nothing to say.
    Empty,
}

/// A number with what it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figure {
    /// The number.
    pub value: f64,
    /// What it is: decides the digits that people are shown.
    pub quantity: Quantity,
    /// What stands behind the number, `*` for example; often nothing.
    pub mark: &'static str,
}

impl Cell {
    /// A number of this kind.
    pub const fn real(value: f64, quantity: Quantity) -> Self {
        Self::Real(Figure { value, quantity, mark: "" })
    }

    /// [`Quantity::Decimals`]
    pub const fn decimals(value: f64, decimals: u8) -> Self {
        Self::real(value, Quantity::Decimals(decimals))
    }

    /// [`Quantity::Measured`]
    pub const fn measured(value: f64) -> Self {
        Self::real(value, Quantity::Measured)
    }

    /// [`Quantity::Ratio`]
    pub const fn ratio(value: f64) -> Self {
        Self::real(value, Quantity::Ratio)
    }

    /// [`Quantity::Percent`]; `value` is in per cent already.
    pub const fn percent(value: f64) -> Self {
        Self::real(value, Quantity::Percent)
    }

    /// [`Quantity::Error`]
    pub const fn error(value: f64) -> Self {
        Self::real(value, Quantity::Error)
    }

    /// The number with a mark behind it; what is no number stays as it is.
    #[must_use]
    pub fn marked(self, mark: &'static str) -> Self {
        match self {
            Self::Real(figure) => Self::Real(Figure { mark, ..figure }),
            other => other,
        }
    }

    /// The entry as a reader sees it; empty for [`Cell::Empty`].
    pub fn text(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            Self::Count(count) => digits::count(*count),
            Self::Int(int) => digits::grouped(&int.to_string()),
            Self::Real(Figure { value, quantity, mark }) => behind(digits::shown(*value, *quantity), mark),
            Self::Flag(true) => "yes".to_owned(),
            Self::Flag(false) => "no".to_owned(),
            Self::Folded(folded) => folded.text(),
            Self::Empty => String::new(),
        }
    }

    /// The entry for programs: numbers with every digit, no commas and no mark.
    pub fn machine_text(&self) -> String {
        match self {
            Self::Count(count) => count.to_string(),
            Self::Int(int) => int.to_string(),
            Self::Real(figure) => digits::exact(figure.value),
            other => other.text(),
        }
    }

    /// The entry in a JSON document, without its mark. JSON has no infinity and no NaN: they are written as text.
    pub(super) fn json(&self) -> Value {
        match self {
            Self::Empty => Value::Null,
            Self::Count(count) => (*count).into(),
            Self::Int(int) => (*int).into(),
            Self::Flag(flag) => (*flag).into(),
            Self::Real(figure) if figure.value.is_finite() => figure.value.into(),
            Self::Real(figure) => digits::exact(figure.value).into(),
            Self::Text(_) | Self::Folded(_) => self.machine_text().into(),
        }
    }

    /// The mark behind a number, if it has one.
    pub(super) const fn mark(&self) -> Option<&'static str> {
        match self {
            Self::Real(figure) if !figure.mark.is_empty() => Some(figure.mark),
            _ => None,
        }
    }

    /// Whether the entry is set flush right.
    pub const fn is_number(&self) -> bool {
        matches!(self, Self::Count(_) | Self::Int(_) | Self::Real(_))
    }
}

fn behind(number: String, mark: &str) -> String {
    if mark.is_empty() { number } else { format!("{number} {mark}") }
}

macro_rules! cell_from {
    ($($from:ty => $variant:ident),* $(,)?) => {
        $(impl From<$from> for Cell {
            fn from(value: $from) -> Self {
                Self::$variant(value.into())
            }
        })*
    };
}
cell_from!(&str => Text, String => Text, u8 => Count, u16 => Count, u32 => Count, u64 => Count, i32 => Int, i64 => Int,
    bool => Flag);

/// Every digit: [`Quantity::Exact`].
impl From<f64> for Cell {
    fn from(value: f64) -> Self {
        Self::real(value, Quantity::Exact)
    }
}

/// Every digit: [`Quantity::Exact`].
impl From<f32> for Cell {
    fn from(value: f32) -> Self {
        f64::from(value).into()
    }
}

impl From<usize> for Cell {
    fn from(value: usize) -> Self {
        Self::Count(value as u64)
    }
}

impl<T: Into<Self>> From<Option<T>> for Cell {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Empty, Into::into)
    }
}
