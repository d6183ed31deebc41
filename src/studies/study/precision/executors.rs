//! Executors of a subject.

use refsim::machine::{Executor, ExecutorKind};

/// The batch and the scalar executor, which keep decoded programs between runs.
#[derive(Clone, Debug)]
pub(super) struct SubjectExecutors {
    pub(super) batch: Executor,
    scalar: Executor,
}

impl SubjectExecutors {
    pub(super) fn new() -> Self {
        Self { batch: ExecutorKind::Batch.into(), scalar: ExecutorKind::Scalar.into() }
    }

    /// Executor of a kind; every kind except scalar runs on the batch executor.
    pub(super) fn of(&self, kind: ExecutorKind) -> &Executor {
        if kind == ExecutorKind::Scalar { &self.scalar } else { &self.batch }
    }
}
