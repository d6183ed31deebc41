//! What a case asks of its card, in order: what the timing model reads.

use refsim::{event::Event, machine::Executor};

use super::{CaseError, Loaded, Setup};

/// Draws the case as [`super::run`] does and returns the machine's log: textures up, targets cleared, the draw, targets and depth
/// buffer back. The same for every executor.
///
/// # Errors
/// If the device cannot do what the case asks.
pub fn log(setup: &Setup, executor: impl Into<Executor>) -> Result<Vec<Event>, CaseError> {
    let mut loaded = Loaded::recording(setup, executor)?;
    loaded.draw()?;
    loaded.targets()?;
    loaded.depth()?;
    Ok(loaded.take_log())
}
