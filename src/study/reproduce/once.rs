//! Values that are computed when they are first asked for.

use std::cell::OnceCell;

/// The value of a cell; computed if it has none yet, and left empty if that fails.
pub(super) fn get_or_try<T, E>(cell: &OnceCell<T>, make: impl FnOnce() -> Result<T, E>) -> Result<&T, E> {
    if let Some(value) = cell.get() {
        return Ok(value);
    }
    let value = make()?;
    Ok(cell.get_or_init(|| value))
}
