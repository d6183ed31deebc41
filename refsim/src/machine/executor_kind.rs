//! Which executor shades fragments.

/// Which executor shades fragments. The bits are the same.
#[non_exhaustive]
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

impl ExecutorKind {
    /// Its name: `scalar`, `batch`, `wgpu`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Scalar => "scalar",
            Self::Batch => "batch",
            #[cfg(feature = "wgpu")]
            Self::Wgpu => "wgpu",
        }
    }
}
