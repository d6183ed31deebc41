//! Event log of a case, the input of the timing model.

use refsim::{
    event::{Event, TexelObserver},
    machine::Executor,
};

use super::{CaseError, Loaded, Setup};

/// Draws the case as [`super::run`] does and returns the machine's log: texture uploads, clears, the draw, read-back of
/// targets and depth buffer. The log is the same for every executor. Fails if the device cannot execute the case.
pub fn log(setup: &Setup, executor: impl Into<Executor>) -> Result<Vec<Event>, CaseError> {
    log_of(Loaded::recording(setup, executor, None)?)
}

/// Like [`log`], with an observer of every texel read. Draws on the scalar executor, which is slow. Fails as [`log`]
/// does.
pub fn log_observed(setup: &Setup, observer: Box<dyn TexelObserver>) -> Result<Vec<Event>, CaseError> {
    log_of(Loaded::recording(setup, refsim::machine::ExecutorKind::Scalar, Some(observer))?)
}

fn log_of(mut loaded: Loaded<'_>) -> Result<Vec<Event>, CaseError> {
    loaded.draw()?;
    loaded.targets()?;
    loaded.depth()?;
    Ok(loaded.take_log())
}
