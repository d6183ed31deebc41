//! Cells of tables as text: a word for the kind, the value with all digits, and the mark of a number.

use crate::report::digits::Quantity;
use crate::report::{Cell, Figure};

/// Marks of numbers in tables.
const MARKS: [&str; 4] = ["", "*", "(implied)", "(inferred)"];

/// Kinds of numbers that have no parameters.
const QUANTITIES: [(&str, Quantity); 5] = [
    ("exact", Quantity::Exact),
    ("measured", Quantity::Measured),
    ("ratio", Quantity::Ratio),
    ("percent", Quantity::Percent),
    ("error", Quantity::Error),
];

/// Encodes a cell, as in `decimals2 0.125 *`; a folded cell becomes its text.
pub(super) fn coded(cell: &Cell) -> String {
    match cell {
        Cell::Empty => String::new(),
        Cell::Text(text) => format!("text {text}"),
        Cell::Folded(_) => format!("text {}", cell.text()),
        Cell::Count(count) => format!("count {count}"),
        Cell::Int(int) => format!("int {int}"),
        Cell::Flag(flag) => format!("flag {flag}"),
        Cell::Real(Figure { value, quantity, mark, .. }) => {
            let kind = QUANTITIES.iter().find(|(_, known)| known == quantity).map(|(name, _)| (*name).to_owned());
            let decimals = || match quantity {
                Quantity::Decimals(decimals) => format!("decimals{decimals}"),
                _ => QUANTITIES[0].0.to_owned(),
            };
            format!("{} {value:?} {mark}", kind.unwrap_or_else(decimals)).trim_end().to_owned()
        }
    }
}

/// Reads a cell; `None` for text that [`coded`] does not write.
pub(super) fn decoded(text: &str) -> Option<Cell> {
    if text.is_empty() {
        return Some(Cell::Empty);
    }
    let (kind, rest) = text.split_once(' ')?;
    Some(match kind {
        "text" => Cell::Text(rest.to_owned()),
        "count" => Cell::Count(rest.parse().ok()?),
        "int" => Cell::Int(rest.parse().ok()?),
        "flag" => Cell::Flag(rest.parse().ok()?),
        _ => {
            let (value, mark) = rest.split_once(' ').unwrap_or((rest, ""));
            let known = || QUANTITIES.iter().find(|(name, _)| *name == kind).map(|(_, quantity)| *quantity);
            let decimals = || Some(Quantity::Decimals(kind.strip_prefix("decimals")?.parse().ok()?));
            let quantity = known().or_else(decimals)?;
            let mark = MARKS.into_iter().find(|known| *known == mark)?;
            Cell::Real(Figure { value: value.parse().ok()?, quantity, mark })
        }
    })
}
