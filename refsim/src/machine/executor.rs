//! An executor from which machines can be made.

use super::{ExecutorKind, Machine, MachineError};
use crate::device::Profile;
use crate::exec::batch::BatchExecutor;
#[cfg(feature = "wgpu")]
use crate::exec::gpu::Gpu;
use std::sync::Arc;

/// An executor with its GPU, if it needs one: for code that makes machines of its own. They share what it has decoded.
#[non_exhaustive]
#[derive(Clone, Debug)]
pub enum Executor {
    /// By kind alone. [`ExecutorKind::Wgpu`] means the best GPU that the computer has.
    Kind {
        /// The kind.
        kind: ExecutorKind,
        /// The programs and textures that batches have been decoded for.
        batch: BatchExecutor,
    },
    /// An opened GPU.
    #[cfg(feature = "wgpu")]
    Gpu {
        /// The GPU.
        gpu: Arc<Gpu>,
    },
}

impl Executor {
    /// Its kind.
    pub fn kind(&self) -> ExecutorKind {
        match self {
            Self::Kind { kind, .. } => *kind,
            #[cfg(feature = "wgpu")]
            Self::Gpu { .. } => ExecutorKind::Wgpu,
        }
    }

    /// A machine that it shades for.
    ///
    /// # Errors
    /// If a GPU is to shade and refuses.
    pub fn machine(&self, profile: impl Into<Arc<Profile>>) -> Result<Machine, MachineError> {
        match self {
            Self::Kind { kind, batch } => Ok(Machine { batch: batch.clone(), ..Machine::new(profile, *kind) }),
            #[cfg(feature = "wgpu")]
            Self::Gpu { gpu } => Machine::with_gpu(profile, Arc::clone(gpu)),
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
