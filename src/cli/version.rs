//! Version text of `crossbar --version`.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use crate::error::InputError;
use crate::kept::unreadable;
use crate::report::sha256;

/// Commit from which the program was built, if `CROSSBAR_COMMIT` named it to the compiler. A build script that asks git
/// would compile the program and its tests anew after each commit.
pub(super) const COMMIT: Option<&str> = option_env!("CROSSBAR_COMMIT");

/// The version, with the program's features, and its commit if known: `0.1.0 (8a205f4a1, features cli, wgpu)`.
pub(super) static VERSION: LazyLock<String> = LazyLock::new(|| {
    let optional = [("wgpu", cfg!(feature = "wgpu")), ("wgsl", cfg!(feature = "wgsl"))];
    let features = optional.iter().filter(|(_, has)| *has).fold("cli".to_owned(), |all, (name, _)| all + ", " + name);
    let commit = COMMIT.map(|commit| format!("{commit}, ")).unwrap_or_default();
    format!("{} ({commit}features {features})", env!("CARGO_PKG_VERSION"))
});

/// Identifies the program that computes a result: version and commit, or, if the commit is
/// not known, the SHA-256 of its file. Fails if the program's own file cannot be read.
pub(super) fn program() -> Result<String, InputError> {
    let version = env!("CARGO_PKG_VERSION");
    if let Some(commit) = COMMIT {
        return Ok(format!("{version} ({commit})"));
    }
    // On Linux, the running program's file can be read even if it has been replaced.
    let path = if cfg!(target_os = "linux") { Ok("/proc/self/exe".into()) } else { std::env::current_exe() };
    let path: PathBuf = path.map_err(|source| unreadable(Path::new("the program"), source))?;
    let digest = File::open(&path).and_then(sha256).map_err(|source| unreadable(&path, source))?;
    Ok(format!("{version} (SHA-256 {digest})"))
}
