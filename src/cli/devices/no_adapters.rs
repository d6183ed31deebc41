//! GPU adapters in a build without the feature `wgpu`: an error that names the feature.

use crate::cli::{Out, Problem};

/// Fails for `devices --adapters`.
pub(super) fn list(_: &mut Out) -> miette::Result<()> {
    Err(missing().into())
}

/// Error that names the missing feature.
pub(in crate::cli) fn missing() -> Problem {
    Problem::usage(
        "this build has no GPU support: the feature `wgpu` is off",
        "build with `cargo build --release --features wgpu`",
    )
}
