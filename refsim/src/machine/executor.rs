//! Which executor shades fragments, and what it needs.

use super::{Machine, MachineError};
use crate::device::Profile;
#[cfg(feature = "wgpu")]
use crate::exec::gpu::Gpu;
use std::sync::Arc;

/// Which executor shades fragments. The bits are the same.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum ExecutorKind {
    /// The reference: one value at a time.
    #[default]
    Scalar,
    /// Tiles of 256 fragments in vector code of the host.
    Batch,
    /// A GPU of the host.
    #[cfg(feature = "wgpu")]
    Wgpu,
}

/// An executor with what it needs, for code that makes machines of its own.
#[derive(Clone, Debug)]
pub enum Executor {
    /// By kind alone. [`ExecutorKind::Wgpu`] means the best GPU that the computer has.
    Kind(ExecutorKind),
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
            Self::Kind(kind) => *kind,
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
            Self::Kind(kind) => Ok(Machine::new(profile, *kind)),
            #[cfg(feature = "wgpu")]
            Self::Gpu { gpu } => Machine::with_gpu(profile, Arc::clone(gpu)),
        }
    }
}

impl Default for Executor {
    fn default() -> Self {
        Self::Kind(ExecutorKind::default())
    }
}

impl From<&Self> for Executor {
    fn from(executor: &Self) -> Self {
        executor.clone()
    }
}

impl From<ExecutorKind> for Executor {
    fn from(kind: ExecutorKind) -> Self {
        Self::Kind(kind)
    }
}
