//! Says which commit an optimised program was built from, for `crossbar --version`; nothing else depends on it.
//!
//! A development build is not asked: its commit changes all the time, and the crate would be compiled anew each time.
//! A package from a registry carries its commit in a file of cargo's; without that and without git there is none.
//! Whoever packages the program may set `CROSSBAR_COMMIT`.

use std::path::Path;
use std::process::Command;
use std::{env, fs};

/// Sources of the program: a change in them marks the commit as modified.
const SOURCES: [&str; 6] = ["build.rs", "Cargo.lock", "Cargo.toml", "refsim/Cargo.toml", "refsim/src", "src"];

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-env-changed=CROSSBAR_COMMIT");
    let program = env::var_os("CARGO_FEATURE_CLI").is_some();
    let optimised = env::var("PROFILE").is_ok_and(|profile| profile == "release");
    if program
        && optimised
        && env::var_os("CROSSBAR_COMMIT").is_none()
        && let Some(commit) = commit_of_package().or_else(commit_of_repository)
    {
        println!("cargo::rustc-env=CROSSBAR_COMMIT={commit}");
    }
}

/// The commit that `cargo package` noted.
fn commit_of_package() -> Option<String> {
    let note = fs::read_to_string(".cargo_vcs_info.json").ok()?;
    let (_, hash) = note.split_once("\"sha1\": \"")?;
    let hash = hash.get(..9)?;
    hash.bytes().all(|byte| byte.is_ascii_hexdigit()).then(|| hash.to_owned())
}

/// The commit that is checked out, if this folder is the root of a repository, not a copy inside another project.
fn commit_of_repository() -> Option<String> {
    if !git(&["rev-parse", "--show-prefix"])?.is_empty() {
        return None;
    }
    let branch = git(&["symbolic-ref", "--quiet", "HEAD"]).unwrap_or_default();
    for file in ["HEAD", "packed-refs", branch.as_str()].into_iter().filter(|file| !file.is_empty()) {
        let path = git(&["rev-parse", "--git-path", file])?;
        // Cargo counts a missing path as changed on every build.
        if Path::new(&path).exists() {
            println!("cargo::rerun-if-changed={path}");
        }
    }
    for path in SOURCES {
        println!("cargo::rerun-if-changed={path}");
    }
    let commit = git(&["rev-parse", "--short=9", "HEAD"])?;
    let changes = git(&[&["status", "--porcelain", "--"], &SOURCES[..]].concat())?;
    Some(if changes.is_empty() { commit } else { format!("{commit}, modified") })
}

/// Output of git in this folder; `None` if git is missing or fails.
fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").args(arguments).output().ok().filter(|output| output.status.success())?;
    Some(String::from_utf8(output.stdout).ok()?.trim_end().to_owned())
}
