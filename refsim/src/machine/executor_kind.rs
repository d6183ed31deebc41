//! Which executor shades fragments.

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
