//! Values of options: code that the parsers of the program and of the studies' own options share.

pub mod number;
pub mod one_of;
mod size;

pub use size::Size;

use crate::geom::exact::Sides;
use one_of::{OneOf, one_of};

/// The values that were given, or the usual ones.
pub fn or<T: Clone>(given: &[T], usual: &[T]) -> Vec<T> {
    if given.is_empty() { usual.to_vec() } else { given.to_vec() }
}

/// Values of `--sides`: the sides of a face that can be hit.
pub fn sides() -> OneOf<Sides> {
    let front = ("front", "The side from which the corners run counter-clockwise", Sides::Front);
    one_of([front, ("both", "Both sides", Sides::Both)])
}
