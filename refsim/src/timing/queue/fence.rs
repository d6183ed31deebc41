//! Fences as in `NV_fence`: marks in the command stream that the host can test or wait for.
//!
//! There is one condition, `ALL_COMPLETED`: a fence is passed when every command before it, transfers included, is
//! done. A fence that was generated but never set can be neither tested nor waited for. Setting a fence again replaces
//! its mark.

use crate::timing::timeline::Mark;

/// Name of a fence of one [`super::Queue`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Fence(pub u32);

/// Error of testing or waiting for a fence.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error, miette::Diagnostic)]
pub enum FenceError {
    /// The fence was generated but never set.
    #[error("expected a fence that has been set, found fence {} that was not", .0.0)]
    #[diagnostic(code(timing::unset_fence), help("set the fence before it is tested or waited for"))]
    Unset(Fence),
    /// The queue has not generated this fence.
    #[error("expected the name of a fence of this queue, found {}", .0.0)]
    #[diagnostic(code(timing::unknown_fence), help("take the name from the queue that is asked"))]
    Unknown(Fence),
}

/// Times at which the fences of a queue are passed.
#[derive(Clone, Debug, Default)]
pub(super) struct Fences(Vec<Option<Mark>>);

impl Fences {
    pub(super) fn generate(&mut self) -> Fence {
        self.0.push(None);
        // A program with 2^32 fences does not fit into memory.
        Fence(u32::try_from(self.0.len() - 1).unwrap_or(u32::MAX))
    }

    pub(super) fn set(&mut self, fence: Fence, passed: Mark) -> Result<(), FenceError> {
        *self.0.get_mut(fence.0 as usize).ok_or(FenceError::Unknown(fence))? = Some(passed);
        Ok(())
    }

    pub(super) fn passed(&self, fence: Fence) -> Result<Mark, FenceError> {
        self.0.get(fence.0 as usize).ok_or(FenceError::Unknown(fence))?.ok_or(FenceError::Unset(fence))
    }

    pub(super) fn check(&self, fence: Fence) -> Result<(), FenceError> {
        self.0.get(fence.0 as usize).map(|_| ()).ok_or(FenceError::Unknown(fence))
    }
}
