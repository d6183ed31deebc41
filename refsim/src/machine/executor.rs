//! Executors that can be shared by several machines.

use super::{DrawWatcher, ExecutorKind, Machine, MachineError};
use crate::device::Profile;
use crate::exec::batch::BatchExecutor;
#[cfg(feature = "wgpu")]
use crate::exec::gpu::Gpu;
use std::sync::Arc;

/// Creates machines with one executor, and with its GPU if needed. These machines share its cache of decoded programs
/// and textures.
#[non_exhaustive]
#[derive(Clone, Debug)]
pub enum Executor {
    /// An executor of the host, or, for [`ExecutorKind::Wgpu`], the best GPU of the host.
    Kind {
        /// The kind.
        kind: ExecutorKind,
        /// Cache of programs and textures decoded for the batch executor.
        batch: BatchExecutor,
    },
    /// An opened GPU.
    #[cfg(feature = "wgpu")]
    Gpu {
        /// The GPU.
        gpu: Arc<Gpu>,
    },
    /// An executor whose machines report every draw to a watcher.
    Watched {
        /// The executor.
        executor: Box<Executor>,
        /// Called before and after each draw of its machines.
        watcher: Arc<dyn DrawWatcher>,
    },
}

impl Executor {
    /// The kind of the executor.
    pub fn kind(&self) -> ExecutorKind {
        match self {
            Self::Kind { kind, .. } => *kind,
            #[cfg(feature = "wgpu")]
            Self::Gpu { .. } => ExecutorKind::Wgpu,
            Self::Watched { executor, .. } => executor.kind(),
        }
    }

    /// Returns this executor with a watcher, which is called for every draw of the machines that it creates from now
    /// on.
    #[must_use]
    pub fn watched(&self, watcher: Arc<dyn DrawWatcher>) -> Self {
        Self::Watched { executor: Box::new(self.clone()), watcher }
    }

    /// Creates a machine that uses this executor.
    ///
    /// # Errors
    /// If the executor is a GPU that cannot be used.
    pub fn machine(&self, profile: impl Into<Arc<Profile>>) -> Result<Machine, MachineError> {
        match self {
            Self::Kind { kind, batch } => Ok(Machine { batch: batch.clone(), ..Machine::new(profile, *kind) }),
            #[cfg(feature = "wgpu")]
            Self::Gpu { gpu } => Machine::with_gpu(profile, Arc::clone(gpu)),
            Self::Watched { executor, watcher } => {
                Ok(Machine { watcher: Some(Arc::clone(watcher)), ..executor.machine(profile)? })
            }
        }
    }
}

impl Default for Executor {
    fn default() -> Self {
        ExecutorKind::default().into()
    }
}

impl From<&Self> for Executor {
    fn from(executor: &Self) -> Self {
        executor.clone()
    }
}

impl From<ExecutorKind> for Executor {
    fn from(kind: ExecutorKind) -> Self {
        Self::Kind { kind, batch: BatchExecutor::default() }
    }
}
