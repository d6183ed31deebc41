//! What can go wrong with a GPU.

use thiserror::Error;

/// Why the GPU can't do what it was asked.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum GpuError {
    /// There is none.
    #[error("no GPU adapter found: install a Vulkan driver (a software one will do, such as Mesa's lavapipe)")]
    NoAdapter,
    /// None has the name that was asked for.
    #[error("no GPU adapter is called `{asked}`; there are: {}", .found.join(", "))]
    UnknownAdapter {
        /// What was asked for.
        asked: String,
        /// The names there are.
        found: Vec<String>,
    },
    /// More than one adapter has the name.
    #[error("`{asked}` names {} GPU adapters: {}; give more of the name", .found.len(), .found.join(", "))]
    AmbiguousAdapter {
        /// What was asked for.
        asked: String,
        /// The names it fits.
        found: Vec<String>,
    },
    /// The adapter refuses to be opened.
    #[error("GPU adapter `{adapter}` can't be opened: {reason}")]
    Open {
        /// Its name.
        adapter: String,
        /// What the driver says.
        reason: String,
    },
    /// A shader or a pipeline is refused: a fault of the generator.
    #[error("GPU shader `{entry}` is refused, which is a fault of this program: {reason}")]
    Shader {
        /// The entry point.
        entry: String,
        /// What the validator or the driver says.
        reason: String,
    },
    /// More memory than the adapter gives.
    #[error(
        "GPU adapter `{adapter}` gives buffers of up to {most} bytes, found {asked}: use smaller targets and textures, or the batch executor"
    )]
    Memory {
        /// Its name.
        adapter: String,
        /// Bytes asked for.
        asked: u64,
        /// Bytes of its largest buffer.
        most: u64,
    },
    /// A command failed or the device was lost.
    #[error("GPU adapter `{adapter}` failed: {reason}")]
    Device {
        /// Its name.
        adapter: String,
        /// What the driver says.
        reason: String,
    },
}
