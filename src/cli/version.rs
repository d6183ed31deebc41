//! Text of `crossbar --version`.

use std::sync::LazyLock;

/// Commit that the program was built from. `build.rs` sets it in optimised builds, whoever packages the program in any.
pub(super) const COMMIT: &str = match option_env!("CROSSBAR_COMMIT") {
    Some(commit) => commit,
    None if cfg!(debug_assertions) => "development build",
    None => "unknown commit",
};

/// The version, where the program comes from and what it was built with: `0.1.0 (8a205f4a1, features cli, wgpu)`.
pub(super) static VERSION: LazyLock<String> = LazyLock::new(|| {
    let features = if cfg!(feature = "wgpu") { "cli, wgpu" } else { "cli" };
    format!("{} ({COMMIT}, features {features})", env!("CARGO_PKG_VERSION"))
});
