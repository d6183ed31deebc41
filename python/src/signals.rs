//! Long work without the interpreter's lock, which Ctrl-C ends.

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

use crossbar::study::ProgressFn;
use pyo3::prelude::*;
use rayon::prelude::*;

/// Elements of one task of a thread.
const TASK: usize = 1 << 14;

/// Fills an array in tasks of at most `task` elements, `together` of them in parallel at a time; signals are handled in
/// between. `work` takes its state, the place of the first element and a part of the array.
pub(crate) fn fill<T: Send, S>(
    py: Python<'_>,
    out: &mut [T],
    (task, together): (usize, usize),
    state: impl Fn() -> S + Sync,
    work: impl Fn(&mut S, usize, &mut [T]) + Sync,
) -> PyResult<()> {
    if out.len() <= task {
        // Quicker than to give the lock away.
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

/// [`fill`] with elements that take nanoseconds.
pub(crate) fn fill_quickly<T: Send, S>(
    py: Python<'_>,
    out: &mut [T],
    state: impl Fn() -> S + Sync,
    work: impl Fn(&mut S, usize, &mut [T]) + Sync,
) -> PyResult<()> {
    fill(py, out, (TASK, 256), state, work)
}

/// Runs a study without the lock. A signal ends it at its next step, by unwinding.
pub(crate) fn study<R: Send>(py: Python<'_>, work: impl FnOnce(&mut ProgressFn<'_>) -> R + Send) -> PyResult<R> {
    /// Payload of the unwinding; nothing is printed.
    struct Interrupted;
    py.detach(|| {
        let mut signal = None;
        let result = catch_unwind(AssertUnwindSafe(|| {
            work(&mut |_, _, _| {
                if let Err(error) = Python::attach(|py| py.check_signals()) {
                    signal = Some(error);
                    resume_unwind(Box::new(Interrupted));
                }
            })
        }));
        match (result, signal) {
            (Ok(result), _) => Ok(result),
            (Err(_), Some(error)) => Err(error),
            (Err(panic), None) => resume_unwind(panic),
        }
    })
}
