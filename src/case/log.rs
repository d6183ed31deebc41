//! What a case asks of its card, in order: what the timing model reads.

use refsim::{
    event::{Event, TexelObserver},
    machine::Executor,
};

use super::{CaseError, Loaded, Setup};

/// Draws the case as [`super::run`] does and returns the machine's log: textures up, targets cleared, the draw, targets
/// and depth buffer back. The same for every executor.
///
/// # Errors
/// If the device cannot do what the case asks.
pub fn log(setup: &Setup, executor: impl Into<Executor>) -> Result<Vec<Event>, CaseError> {
    log_of(Loaded::recording(setup, executor, None)?)
}

/// The same log with what the observer makes of every texel that is read. The scalar executor draws, slowly.
///
/// # Errors
/// As [`log`].
pub fn log_observed(setup: &Setup, observer: Box<dyn TexelObserver>) -> Result<Vec<Event>, CaseError> {
    log_of(Loaded::recording(setup, refsim::machine::ExecutorKind::Scalar, Some(observer))?)
}

fn log_of(mut loaded: Loaded<'_>) -> Result<Vec<Event>, CaseError> {
    loaded.draw()?;
    loaded.targets()?;
    loaded.depth()?;
    Ok(loaded.take_log())
}
