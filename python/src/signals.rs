//! Runs long work without the interpreter's lock; Ctrl-C interrupts it.

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use crossbar::study::ProgressFn;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::prelude::*;

/// Elements per task of a thread.
const TASK: usize = 1 << 14;

/// Fills an array in tasks of at most `task` elements, with `together` tasks in parallel; then it handles signals.
/// `work` receives its state, the index of the first element and a part of the array.
pub(crate) fn fill<T: Send, S>(
    py: Python<'_>,
    out: &mut [T],
    (task, together): (usize, usize),
    state: impl Fn() -> S + Sync,
    work: impl Fn(&mut S, usize, &mut [T]) + Sync,
) -> PyResult<()> {
    if out.len() <= task {
        // This is faster than releasing the lock.
        work(&mut state(), 0, out);
        return Ok(());
    }
    for (number, part) in out.chunks_mut(task * together).enumerate() {
        let start = number * task * together;
        py.detach(|| {
            let tasks = part.par_chunks_mut(task).enumerate();
            tasks.for_each_init(&state, |state, (index, out)| work(state, start + index * task, out));
        });
        py.check_signals()?;
    }
    Ok(())
}

/// [`fill`] for elements that need only nanoseconds each.
pub(crate) fn fill_quickly<T: Send, S>(
    py: Python<'_>,
    out: &mut [T],
    state: impl Fn() -> S + Sync,
    work: impl Fn(&mut S, usize, &mut [T]) + Sync,
) -> PyResult<()> {
    fill(py, out, (TASK, 256), state, work)
}

/// Maximum delay of Ctrl-C.
const POLL: Duration = Duration::from_millis(20);

/// Runs a study on its own thread, without the lock. After Ctrl-C it returns at once; the study ends at its next step.
pub(crate) fn study<R: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce(&mut ProgressFn<'_>) -> R + Send + 'static,
) -> PyResult<R> {
    /// Payload of the unwinding; nothing is printed.
    struct Interrupted;
    let is_over = Arc::new(AtomicBool::new(false));
    let seen = Arc::clone(&is_over);
    let result = aside(py, move || {
        work(&mut |_, _, _| {
            if seen.load(Ordering::Relaxed) {
                resume_unwind(Box::new(Interrupted));
            }
        })
    });
    is_over.store(true, Ordering::Relaxed);
    result
}

/// Runs work on its own thread, without the lock. After Ctrl-C it returns at once; the work continues to its end, and
/// its result is discarded.
pub(crate) fn aside<R: Send + 'static>(py: Python<'_>, work: impl FnOnce() -> R + Send + 'static) -> PyResult<R> {
    let (sender, mut receiver) = mpsc::channel();
    thread::Builder::new().name("crossbar".to_owned()).spawn(move || {
        // The result of an interrupted call is discarded.
        let _ = sender.send(catch_unwind(AssertUnwindSafe(work)));
    })?;
    loop {
        let waiting = &mut receiver;
        match py.detach(move || waiting.recv_timeout(POLL)) {
            Ok(Ok(result)) => return Ok(result),
            Ok(Err(panic)) => resume_unwind(panic),
            Err(RecvTimeoutError::Timeout) => py.check_signals()?,
            Err(gone @ RecvTimeoutError::Disconnected) => return Err(PyRuntimeError::new_err(gone.to_string())),
        }
    }
}
