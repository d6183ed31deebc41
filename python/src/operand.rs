//! Operands, read element by element in C order, in the shape of the result.

use numpy::ndarray::{ArrayViewD, Axis};
use numpy::{Element, PyReadonlyArrayDyn};

/// Elements of an operand: a contiguous array, a single element for all, or a strided array.
pub(crate) enum Operand<'a, T> {
    All(&'a [T]),
    One([T; 1]),
    Strided(ArrayViewD<'a, T>),
}

impl<'a, T: Element + Copy> Operand<'a, T> {
    /// An array with the result's shape, or with one element.
    pub(crate) fn new(array: &'a PyReadonlyArrayDyn<'_, T>) -> Self {
        let view = array.as_array();
        // Not `array.as_slice()`, which also succeeds in Fortran order.
        match (view.to_slice(), view.first()) {
            (_, Some(&one)) if view.len() == 1 => Self::One([one]),
            (Some(all), _) => Self::All(all),
            (None, _) => Self::Strided(view),
        }
    }

    /// `length` elements from `start`, or the single element; elements of strided operands are copied to the buffer.
    pub(crate) fn part<'b>(&'b self, start: usize, length: usize, buffer: &'b mut Vec<T>) -> &'b [T] {
        match self {
            Self::All(all) => all.get(start..start + length).unwrap_or_default(),
            Self::One(one) => one,
            Self::Strided(view) => {
                collect(view, start, length, buffer);
                buffer
            }
        }
    }
}

/// Collects elements row by row.
fn collect<T: Copy>(view: &ArrayViewD<'_, T>, start: usize, length: usize, buffer: &mut Vec<T>) {
    buffer.clear();
    let columns = view.shape().last().copied().unwrap_or(1).max(1);
    let mut column = start % columns;
    for row in start / columns.. {
        let mut line = view.view();
        let mut rest = row;
        // The next axis to the left varies fastest among the remaining axes.
        while line.ndim() > 1 {
            let axis = line.ndim() - 2;
            let side = line.len_of(Axis(axis)).max(1);
            line = line.index_axis_move(Axis(axis), rest % side);
            rest /= side;
        }
        buffer.extend(line.iter().skip(column).take(length - buffer.len()));
        column = 0;
        if buffer.len() >= length || line.is_empty() {
            return;
        }
    }
}
