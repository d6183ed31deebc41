//! Errors of GPUs.

use thiserror::Error;

/// Error of using a GPU.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum GpuError {
    /// No adapter was found.
    #[error("no GPU adapter found: install a Vulkan driver (a software one will do, such as Mesa's lavapipe)")]
    NoAdapter,
    /// No adapter has the given name.
    #[error("no GPU adapter is called `{asked}`; there are: {}", .found.join(", "))]
    UnknownAdapter {
        /// The given name.
        asked: String,
        /// Names of the adapters.
        found: Vec<String>,
    },
    /// Several adapters match the name.
    #[error("`{asked}` matches {} GPU adapters: {}; write more of the name", .found.len(), .found.join(", "))]
    AmbiguousAdapter {
        /// The given name.
        asked: String,
        /// Names of the matching adapters.
        found: Vec<String>,
    },
    /// The adapter cannot be opened.
    #[error("GPU adapter `{adapter}` can't be opened: {reason}")]
    Open {
        /// Name of the adapter.
        adapter: String,
        /// Message of the driver.
        reason: String,
    },
    /// A shader or a pipeline is invalid: a bug in the shader generator.
    #[error("GPU shader `{entry}` is rejected, a bug of this program: {reason}")]
    Shader {
        /// The entry point.
        entry: String,
        /// Message of the validator or the driver.
        reason: String,
    },
    /// The adapter has too little memory.
    #[error(
        "GPU adapter `{adapter}` allows buffers of {most} bytes, {asked} are needed: use smaller targets and textures, or the batch executor"
    )]
    Memory {
        /// Name of the adapter.
        adapter: String,
        /// Bytes requested.
        asked: u64,
        /// Maximum size of a buffer, in bytes.
        most: u64,
    },
    /// A command failed, or the device was lost.
    #[error("GPU adapter `{adapter}` failed: {reason}")]
    Device {
        /// Name of the adapter.
        adapter: String,
        /// Message of the driver.
        reason: String,
    },
}
