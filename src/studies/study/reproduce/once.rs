//! Lazily computed values.

use std::cell::OnceCell;

/// Returns the value of a cell; computes it if the cell is empty, and leaves the cell empty if that fails.
pub(super) fn get_or_try<T, E>(cell: &OnceCell<T>, make: impl FnOnce() -> Result<T, E>) -> Result<&T, E> {
    if let Some(value) = cell.get() {
        return Ok(value);
    }
    let value = make()?;
    Ok(cell.get_or_init(|| value))
}
