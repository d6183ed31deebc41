//! Kinds of executors.

/// Kind of executor that shades fragments. All kinds produce the same bits.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum ExecutorKind {
    /// The reference executor: one value at a time.
    #[default]
    Scalar,
    /// Tiles of 256 fragments, with the host's SIMD instructions.
    Batch,
    /// A GPU of the host.
    #[cfg(feature = "wgpu")]
    Wgpu,
}

impl ExecutorKind {
    /// The name: `scalar`, `batch`, `wgpu`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Scalar => "scalar",
            Self::Batch => "batch",
            #[cfg(feature = "wgpu")]
            Self::Wgpu => "wgpu",
        }
    }
}
