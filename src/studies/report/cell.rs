//! Table cells.

use serde_json::Value;

use super::digits::{self, Quantity};

/// Cell of a table.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// Text.
    Text(String),
    /// Unsigned count.
    Count(u64),
    /// Signed integer.
    Int(i64),
    /// Measured or computed number.
    Real(Figure),
    /// Boolean, shown as yes or no.
    Flag(bool),
    /// Summary of rows that were omitted because their results equal those of a row above.
    Folded(Folded),
    /// Empty cell.
    Empty,
}

/// Number with its kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figure {
    /// Value.
    pub value: f64,
    /// Kind of quantity: determines the digits shown to people.
    pub quantity: Quantity,
    /// Mark after the number, for example `*`; usually empty.
    pub mark: &'static str,
}

/// Cell that replaces folded rows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Folded {
    /// Noun for the rows, singular and plural: `switch`, `switches`.
    pub rows: [&'static str; 2],
    /// Common property of these rows and the row above, such as `the same bits`.
    pub same: &'static str,
    /// Name of the row above.
    pub first: String,
    /// Names of the folded rows.
    pub names: Vec<String>,
}

impl Folded {
    /// Number of folded rows and their common property: `17 switches: the same bits`.
    pub fn text(&self) -> String {
        let rows = self.rows[usize::from(self.names.len() != 1)];
        format!("{} {rows}: {}", self.names.len(), self.same)
    }

    /// Sentence with the names of the folded rows, for the note below the table.
    pub fn note(&self) -> String {
        let mut same = self.same.chars();
        let capital = same.next().map(|first| first.to_ascii_uppercase()).into_iter();
        let same: String = capital.chain(same).collect();
        format!("{same} as {}: {}", self.first, self.names.join(", "))
    }
}

impl Cell {
    /// Creates a number of this kind.
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

    /// [`Quantity::Percent`]; `value` is already in percent.
    pub const fn percent(value: f64) -> Self {
        Self::real(value, Quantity::Percent)
    }

    /// [`Quantity::Error`]
    pub const fn error(value: f64) -> Self {
        Self::real(value, Quantity::Error)
    }

    /// Adds a mark to a number; other cells are unchanged.
    #[must_use]
    pub fn marked(self, mark: &'static str) -> Self {
        match self {
            Self::Real(figure) => Self::Real(Figure { mark, ..figure }),
            other => other,
        }
    }

    /// Formats the cell for people; empty for [`Cell::Empty`].
    pub fn text(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            Self::Count(count) => digits::count(*count),
            Self::Int(int) => digits::grouped(&int.to_string()),
            Self::Real(Figure { value, quantity, mark, .. }) => behind(digits::shown(*value, *quantity), mark),
            Self::Flag(true) => "yes".to_owned(),
            Self::Flag(false) => "no".to_owned(),
            Self::Folded(folded) => folded.text(),
            Self::Empty => String::new(),
        }
    }

    /// Formats the cell for programs: numbers with all digits, no commas and no mark.
    pub fn machine_text(&self) -> String {
        match self {
            Self::Count(count) => count.to_string(),
            Self::Int(int) => int.to_string(),
            Self::Real(figure) => digits::exact(figure.value),
            other => other.text(),
        }
    }

    /// Converts the cell to JSON, without its mark. JSON has no infinity and no NaN: they are written as strings.
    pub fn json(&self) -> Value {
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

    pub(super) const fn mark(&self) -> Option<&'static str> {
        match self {
            Self::Real(figure) if !figure.mark.is_empty() => Some(figure.mark),
            _ => None,
        }
    }

    /// Returns `true` if the cell is right-aligned.
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

/// Creates a [`Quantity::Exact`] number, with all digits.
impl From<f64> for Cell {
    fn from(value: f64) -> Self {
        Self::real(value, Quantity::Exact)
    }
}

/// Creates a [`Quantity::Exact`] number, with all digits.
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
